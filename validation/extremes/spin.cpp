// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/extremes/spin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::validation::inline extremes {
namespace {

using Real = long double;
using Components = std::array<Real, 4>;  // of a unit quaternion, scalar first
constexpr int order = 22;                // of the Taylor series

Components product(const Components& a, const Components& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3], a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1]};
}

Real norm(const std::array<Real, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace

PeriodicSpin::PeriodicSpin(const std::array<double, 3>& moments, const std::array<double, 3>& angular_velocity) {
  for (std::size_t i = 0; i < 3; ++i) {
    start_.moments[i] = moments[i];
    start_.w[i] = angular_velocity[i];
    axis_[i] = start_.moments[i] * start_.w[i];
  }
  const Real momentum = norm(axis_);
  for (Real& component : axis_) component /= momentum;
  longest_step_ = Real(0.25) / norm(start_.w);
  find_period();
  find_angle();
}

PeriodicSpin::Top PeriodicSpin::advance(Top top, Real time) const {
  oracle::TopSeries<Real> series(order);
  const Real steps = std::ceil(std::fabs(time) / longest_step_);
  for (Real i = 0; i < steps; i += 1) series.step(top, time / steps);
  return top;
}

/// The second return of ω₂ to zero, which it then passes as at the start.
void PeriodicSpin::find_period() {
  const auto& m = start_.moments;
  oracle::TopSeries<Real> series(order);
  Top top = start_;
  int changes = 0;
  Real t = 0;
  while (changes < 2) {
    const bool was_positive = top.w[1] > 0;
    series.step(top, longest_step_);
    if (t > 0 && (top.w[1] > 0) != was_positive) ++changes;
    t += longest_step_;
  }
  for (int i = 0; i < 20; ++i) {
    const Real rate = (m[2] - m[0]) / m[1] * top.w[2] * top.w[0];
    const Real correction = -top.w[1] / rate;
    if (!(std::fabs(correction) > 1e-19L * t)) break;
    t += correction;
    top = advance(top, correction);
  }
  period_ = t;
}

/// Attitude after a period = turn by ψ about the momentum; only ψ/2 modulo 2π matters.
void PeriodicSpin::find_angle() {
  const Components after = advance(start_, period_).q;
  Real sine = 0;
  for (std::size_t i = 0; i < 3; ++i) sine += axis_[i] * after[i + 1];
  angle_ = 2 * std::atan2(sine, after[0]);
}

double PeriodicSpin::error(const numeric::Rotation& rotation, double time) const {
  const Real periods = std::round(time / period_);
  const Top rest = advance(start_, std::fma(-periods, period_, static_cast<Real>(time)));
  const Real half = std::remainder(periods * angle_ / 2, 2 * std::numbers::pi_v<Real>);
  const Components turn{std::cos(half), std::sin(half) * axis_[0], std::sin(half) * axis_[1],
                        std::sin(half) * axis_[2]};
  const Components exact = product(turn, rest.q);
  const auto& a = rotation.attitude;
  const double found[4] = {a.w(), a.x(), a.y(), a.z()};
  Real same = 0, other = 0, worst = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    same = std::fmax(same, std::fabs(found[i] - exact[i]));
    other = std::fmax(other, std::fabs(found[i] + exact[i]));
  }
  for (std::size_t i = 0; i < 3; ++i)
    worst = std::fmax(worst, std::fabs(rotation.angular_velocity[static_cast<int>(i)] - rest.w[i]) / norm(rest.w));
  if (!rotation.attitude.coeffs().allFinite() || !rotation.angular_velocity.allFinite()) return std::nan("");
  return static_cast<double>(std::fmax(worst, std::fmin(same, other)));
}

}  // namespace clatter::validation::inline extremes
