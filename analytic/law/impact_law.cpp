// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/impact_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"

namespace clatter::analytic {

using detail::refuse;

double ImpactLaw::most_friction() const { return friction == FrictionKind::none ? 0 : std::fabs(friction_value); }

void ImpactLaw::validate() const {
  if (!(restitution >= 0 && restitution <= 1)) refuse("restitution", restitution, "between 0 and 1");
  if (!std::isfinite(friction_value)) refuse("friction", friction_value, "finite");
  if (friction == FrictionKind::none && friction_value != 0) refuse("friction of no kind", friction_value, "0");
  if (has_cone() && !(friction_value >= 0)) refuse("friction", friction_value, "at least 0");
  if (friction == FrictionKind::moreau && law != RestitutionLaw::newton) {
    throw std::domain_error("friction at the end of an impact (Moreau): goes with Newton's restitution alone");
  }
  if (!(damping_per_stiffness >= 0 && std::isfinite(damping_per_stiffness))) {
    refuse("damping per stiffness", damping_per_stiffness, "at least 0 and finite");
  }
  if (law == RestitutionLaw::viscoelastic && restitution != 1) {
    refuse("restitution", restitution, "1 for the viscoelastic law");
  }
  const double square = ratio_direction.squaredNorm();
  if (!(std::fabs(square - 1) <= 16 * std::numeric_limits<double>::epsilon())) {
    refuse("length of the impulse ratio's direction", std::sqrt(square), "1");
  }
}

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
