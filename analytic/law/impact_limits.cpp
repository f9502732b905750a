// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/impact_limits.hpp"

#include <algorithm>
#include <cmath>

#include "analytic/base/limits.hpp"

namespace clatter::analytic {

using detail::infinite;

namespace {

/// Numerator over denominator, infinite with the numerator's sign where the denominator vanishes.
double quotient(double numerator, double denominator) {
  return denominator == 0 ? std::copysign(infinite, numerator) : numerator / denominator;
}

}  // namespace

double sticking_ratio(const ContactInertia& inertia) { return inertia.coupling / inertia.tangential; }

double jamming_ratio(const ContactInertia& inertia) { return quotient(inertia.normal, inertia.coupling); }

double slip_stopping_ratio(const ContactInertia& inertia, const LimitState& state) {
  const double rise = -(1 + state.restitution) * state.approach_speed;  // (1+e) u
  return quotient(inertia.normal * state.slip + rise * inertia.coupling,
                  inertia.coupling * state.slip + rise * inertia.tangential);
}

EnergyNeutralRatios energy_neutral_ratios(const ContactInertia& inertia, const LimitState& state) {
  const double e = state.restitution;
  const double eta = -state.slip / state.approach_speed;
  const double square = 2 * eta * inertia.coupling + (1 + e) * inertia.tangential;
  const double half = eta * inertia.normal + e * inertia.coupling;
  const double constant = (1 - e) * inertia.normal;
  const double root = std::sqrt(half * half + square * constant);
  if (!(square > 0) || std::isnan(root)) return {-infinite, infinite};
  // The root of smaller magnitude follows from the product of both, so that nothing cancels.
  const double far = half + std::copysign(root, half);
  const double first = far / square;
  const double second = far == 0 ? 0 : -constant / far;
  return {std::min(first, second), std::max(first, second)};
}

double energy_neutral_ratio(const ContactInertia& inertia, const LimitState& state) {
  const auto [lower, upper] = energy_neutral_ratios(inertia, state);
  return slip_stopping_ratio(inertia, state) >= 0 ? upper : lower;
}

double admissible_ratio(const ContactInertia& inertia, const LimitState& state) {
  return std::min(std::fabs(slip_stopping_ratio(inertia, state)), std::fabs(energy_neutral_ratio(inertia, state)));
}

}  // namespace clatter::analytic
