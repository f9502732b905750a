// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's and Euler's equations of a rigid body.
#pragma once

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

/// Resultant of the forces on a body.
struct BodyWrench {
  Vector3 force = Vector3::Zero();   ///< world frame [N]
  Vector3 moment = Vector3::Zero();  ///< about the centre of mass, body frame [N·m]
};

struct Acceleration {
  Vector3 linear = Vector3::Zero();   ///< of the centre of mass, world frame [m/s²]
  Vector3 angular = Vector3::Zero();  ///< ω̇′, body frame [rad/s²]
};

/// The equations of motion of one body, which every contact is stepped with:
///     m R̈ = F,    I ω̇′ = M′ − ω′ × I ω′.
/// They are Eqs. 1 and 2 of Shan et al. (2005) without their redundant fourth parameter; see lagrange_system.hpp.
/// Accuracy: a few eps, of ω̇′ times the ratio of the largest to the smallest moment of inertia.  No allocation.
class NewtonEuler {
 public:
  /// `mass` [kg]; `inertia` about the centre of mass, body frame, symmetric [kg·m²].
  /// @throws std::domain_error if the mass is not positive or the inertia not that of a body (check_inertia).
  NewtonEuler(double mass, const Matrix3& inertia);

  [[nodiscard]] Acceleration acceleration(const Vector3& angular_velocity, const BodyWrench& wrench) const {
    return {.linear = linear(wrench.force), .angular = angular(angular_velocity, wrench.moment)};
  }
  /// R̈ by the force [m/s²].
  [[nodiscard]] Vector3 linear(const Vector3& force) const { return force / mass_; }
  /// ω̇′ by the moment and the body's own turning [rad/s²].
  [[nodiscard]] Vector3 angular(const Vector3& angular_velocity, const Vector3& moment) const {
    return response(moment - angular_velocity.cross(inertia_ * angular_velocity));
  }
  /// What a moment by itself adds to ω̇′, or an angular impulse to ω′: I⁻¹ M′.
  [[nodiscard]] Vector3 response(const Vector3& moment) const { return inverse_inertia_ * moment; }
  /// The same of a body that can only turn about the unit vector `axis` (body frame).
  [[nodiscard]] Vector3 response_about(const Vector3& axis, const Vector3& moment) const {
    return axis * (axis.dot(moment) / axis.dot(inertia_ * axis));
  }

 private:
  double mass_;
  Matrix3 inertia_, inverse_inertia_;
};

}  // namespace clatter::numeric
