// SPDX-License-Identifier: GPL-3.0-or-later
// Torque-free rotation that trigonometric functions describe.
#pragma once

#include "numeric/motion/rotation.hpp"

namespace clatter::numeric {

/// Torque-free rotation about a fixed axis, or of a body with two equal principal moments.
///     A(t)  = A₀ R(p, |p| t) R(s, σ t)          precession about the momentum, spin about the axis of symmetry
///     ω′(t) = R(s, −σ t) ω′₀,   p = ω′₀ − σ s = I ω′₀/I_t,   σ = (1 − I_s/I_t) s·ω′₀
/// with R(a, φ) the turn by φ about a; σ = 0 is a rotation about a fixed axis.
class SteadyPrecession {
 public:
  struct Rates {
    Vector3 precession = Vector3::Zero();  ///< p, body frame at the start [rad/s]
    Vector3 spin_axis = Vector3::UnitZ();  ///< s, unit, body frame
    double spin = 0;                       ///< σ [rad/s]
  };
  SteadyPrecession(const Rotation& start, const Rates& rates);
  /// About the fixed axis of the angular velocity.
  explicit SteadyPrecession(const Rotation& start) : SteadyPrecession(start, {.precession = start.angular_velocity}) {}

  [[nodiscard]] Rotation at(double time) const;
  [[nodiscard]] double largest_speed() const;
  [[nodiscard]] double largest_acceleration() const;

 private:
  Rotation start_;
  Vector3 precession_axis_ = Vector3::UnitZ();
  double precession_ = 0;
  Vector3 spin_axis_;
  double spin_;
};

}  // namespace clatter::numeric
