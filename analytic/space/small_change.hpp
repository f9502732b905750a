// SPDX-License-Identifier: GPL-3.0-or-later
// Small changes of a state, by which derivatives are taken as differences.
#pragma once

#include "analytic/space/body.hpp"

namespace clatter::analytic::space {

/// Relative step of central differences: rounding leaves ten digits, the second order twelve.
inline constexpr double relative_step = 1e-6;
/// Largest error of an attitude [rad], and share of a velocity, that counts as first order.
inline constexpr double first_order = 0.02;

inline Quaternion turned(const Vector3& angle, const Quaternion& attitude) {
  return (Quaternion(1, angle[0] / 2, angle[1] / 2, angle[2] / 2) * attitude).normalized();
}

/// Rotation vector from q to p, small.
inline Vector3 small_rotation(const Quaternion& p, const Quaternion& q) {
  const Quaternion d = p * q.conjugate();
  return (d.w() < 0 ? -2 : 2) * d.vec();
}

inline State shifted(const State& state, int number, double step) {
  State s = state;
  const int axis = number % 3;
  if (number < 3) s.attitude = turned(step * Vector3::Unit(axis), s.attitude);
  else if (number < 6) s.velocity[axis] += step;
  else s.angular_velocity[axis] += step;
  return s;
}

}  // namespace clatter::analytic::space
