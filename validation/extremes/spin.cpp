#include "validation/extremes/spin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::validation {
namespace {

using Real = long double;
using Quaternion = std::array<Real, 4>;

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3], a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1]};
}

Real norm(const std::array<Real, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace

PeriodicSpin::PeriodicSpin(const std::array<double, 3>& moments, const std::array<double, 3>& angular_velocity) {
  for (std::size_t i = 0; i < 3; ++i) {
    moments_[i] = moments[i];
    start_.omega[i] = angular_velocity[i];
    axis_[i] = moments_[i] * start_.omega[i];
  }
  const Real momentum = norm(axis_);
  for (Real& component : axis_) component /= momentum;
  longest_step_ = Real(0.25) / norm(start_.omega);
  find_period();
  find_angle();
}

/// Taylor series of Euler's equations and of the quaternion: recurrences for the coefficients, then Horner's rule.
PeriodicSpin::State PeriodicSpin::step(const State& state, Real h) const {
  constexpr std::size_t order = 22;
  std::array<std::array<Real, order + 1>, 3> w;
  std::array<std::array<Real, order + 1>, 4> q;
  for (std::size_t i = 0; i < 3; ++i) w[i][0] = state.omega[i];
  for (std::size_t i = 0; i < 4; ++i) q[i][0] = state.attitude[i];
  for (std::size_t n = 0; n < order; ++n) {
    const auto times = [n](const auto& a, const auto& b) {
      Real sum = 0;
      for (std::size_t k = 0; k <= n; ++k) sum += a[k] * b[n - k];
      return sum;
    };
    const Real next = static_cast<Real>(n + 1);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      w[i][n + 1] = (moments_[j] - moments_[k]) / moments_[i] * times(w[j], w[k]) / next;
      q[i + 1][n + 1] = (times(q[0], w[i]) + times(q[j + 1], w[k]) - times(q[k + 1], w[j])) / (2 * next);
    }
    q[0][n + 1] = -(times(q[1], w[0]) + times(q[2], w[1]) + times(q[3], w[2])) / (2 * next);
  }
  const auto value = [h](const auto& series) {
    Real sum = series[order];
    for (std::size_t k = order; k-- > 0;) sum = sum * h + series[k];
    return sum;
  };
  State out;
  for (std::size_t i = 0; i < 3; ++i) out.omega[i] = value(w[i]);
  for (std::size_t i = 0; i < 4; ++i) out.attitude[i] = value(q[i]);
  return out;
}

PeriodicSpin::State PeriodicSpin::advance(State state, Real time) const {
  const Real steps = std::ceil(std::fabs(time) / longest_step_);
  for (Real i = 0; i < steps; i += 1) state = step(state, time / steps);
  return state;
}

/// The second return of ω₂ to zero, which it then passes as at the start.
void PeriodicSpin::find_period() {
  State state = start_;
  int changes = 0;
  Real t = 0;
  while (changes < 2) {
    const State next = step(state, longest_step_);
    if (t > 0 && (next.omega[1] > 0) != (state.omega[1] > 0)) ++changes;
    state = next;
    t += longest_step_;
  }
  for (int i = 0; i < 20; ++i) {
    const Real rate = (moments_[2] - moments_[0]) / moments_[1] * state.omega[2] * state.omega[0];
    const Real correction = -state.omega[1] / rate;
    if (!(std::fabs(correction) > 1e-19L * t)) break;
    t += correction;
    state = advance(state, correction);
  }
  period_ = t;
}

/// Attitude after a period = turn by ψ about the momentum; only ψ/2 modulo 2π matters.
void PeriodicSpin::find_angle() {
  const Quaternion after = advance(start_, period_).attitude;
  Real sine = 0;
  for (std::size_t i = 0; i < 3; ++i) sine += axis_[i] * after[i + 1];
  angle_ = 2 * std::atan2(sine, after[0]);
}

double PeriodicSpin::error(const numeric::Rotation& rotation, double time) const {
  const Real periods = std::round(time / period_);
  const State rest = advance(start_, std::fma(-periods, period_, static_cast<Real>(time)));
  const Real half = std::remainder(periods * angle_ / 2, 2 * std::numbers::pi_v<Real>);
  const Quaternion turn{std::cos(half), std::sin(half) * axis_[0], std::sin(half) * axis_[1],
                        std::sin(half) * axis_[2]};
  const Quaternion exact = product(turn, rest.attitude);
  const auto& a = rotation.attitude;
  const double found[4] = {a.w(), a.x(), a.y(), a.z()};
  Real same = 0, other = 0, worst = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    same = std::fmax(same, std::fabs(found[i] - exact[i]));
    other = std::fmax(other, std::fabs(found[i] + exact[i]));
  }
  for (std::size_t i = 0; i < 3; ++i)
    worst =
        std::fmax(worst, std::fabs(rotation.angular_velocity[static_cast<int>(i)] - rest.omega[i]) / norm(rest.omega));
  if (!rotation.attitude.coeffs().allFinite() || !rotation.angular_velocity.allFinite()) return std::nan("");
  return static_cast<double>(std::fmax(worst, std::fmin(same, other)));
}

}  // namespace clatter::validation
