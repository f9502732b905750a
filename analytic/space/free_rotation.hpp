// SPDX-License-Identifier: GPL-3.0-or-later
// Torque-free rotation of a body in space, in closed form.
#pragma once

#include <optional>

#include "analytic/space/theta_rotation.hpp"

namespace clatter::analytic::space {

/// What heights above the ground need of a rotation: e = Aᵀ z, the vertical in body axes, and its rates.
/// A point at r in the body is e·r above the centre of mass.
struct Vertical {
  Vector3 direction = Vector3::UnitZ();  ///< e
  Vector3 rate = Vector3::Zero();        ///< ė = e × ω [1/s]
  Vector3 second = Vector3::Zero();      ///< ë = ė × ω + e × ω̇ [1/s²]
};

/// Rotation without torque: about a fixed axis (a sphere, a principal axis), or by ThetaRotation.
/// Accuracy: a few ulp of double, and of long double × the number of radians turned; near the separatrix a relative
/// error of the start grows by 1/k′² of theta_rotation.hpp (1), with which long double rounding counts too.
class FreeRotation {
 public:
  FreeRotation(const PrincipalAxes& principal, const Quaternion& attitude, const Vector3& angular_velocity);

  /// Body to world, unit.
  [[nodiscard]] Quaternion attitude(double time) const;
  /// Body axes [rad/s].
  [[nodiscard]] Vector3 angular_velocity(double time) const;
  [[nodiscard]] Vertical vertical(double time) const;

  /// Bound on |ω| at all times [rad/s].
  [[nodiscard]] double fastest() const { return fastest_; }
  /// About a fixed axis, or no rotation at all.
  [[nodiscard]] bool is_steady() const { return !theta_; }
  /// The rotation of different principal moments, unless it is steady.
  [[nodiscard]] const std::optional<ThetaRotation>& theta() const { return theta_; }
  /// Bound γ <= 1/√2 in |ω̇| <= γ |ω|²: from Euler's equations, whose coefficients are below 1 by the triangle
  /// inequality.
  [[nodiscard]] double acceleration_factor() const { return acceleration_factor_; }
  /// The axis that the momentum circles, or of a steady rotation; body frame, unit.
  [[nodiscard]] const Vector3& spin_axis() const { return axis_; }
  /// Bound on the speed at which spin_axis() turns, |ω| across that axis [rad/s].
  [[nodiscard]] double axis_speed() const { return axis_speed_; }
  /// Bound on how far the point `place` comes below the centre of mass at any time, from |r| and the angles that r and
  /// the vertical make with the momentum [m].
  [[nodiscard]] double depth(const Vector3& place) const;

 private:
  struct Spin {
    Vector3 vertical, velocity;  ///< e, ω in axes 1 to 3
  };
  [[nodiscard]] Spin spin(double time) const;
  [[nodiscard]] Vertical steady_vertical(double time) const;

  std::optional<ThetaRotation> theta_;
  Quaternion start_;                           ///< attitude at t = 0
  Vector3 start_vertical_ = Vector3::UnitZ();  ///< e at t = 0
  Vector3 axis_ = Vector3::UnitX();            ///< spin_axis()
  long double speed_ = 0;                      ///< of a steady rotation [rad/s]
  Matrix3 axes_ = Matrix3::Identity();         ///< columns: axes 1, 2, 3 in the body frame
  Quaternion axes_attitude_, frame_;           ///< as quaternions; frame of the momentum to world
  Vector3 frame_vertical_ = Vector3::UnitZ();  ///< world's vertical in the frame of the momentum
  Vector3 inverse_moments_ = Vector3::Ones();  ///< |L|/I_i
  Vector3 coefficients_ = Vector3::Zero();     ///< (I₂ − I₃)/I₁ and so on
  double fastest_ = 0, acceleration_factor_ = 0, axis_speed_ = 0;
};

}  // namespace clatter::analytic::space
