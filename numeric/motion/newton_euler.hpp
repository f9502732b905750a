// Newton's and Euler's equations of a rigid body.
#pragma once

#include <Eigen/Cholesky>

#include "numeric/linear_algebra.hpp"

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

/// The equations of motion of one body:
///     m R̈ = F,    I ω̇′ = M′ − ω′ × I ω′.
/// They are Eqs. 1 and 2 of Shan et al. (2005) without their redundant fourth parameter; see lagrange_system.hpp.
class NewtonEuler {
 public:
  /// `mass` [kg]; `inertia` about the centre of mass, body frame, symmetric [kg·m²].
  /// @throws std::domain_error if the mass is not positive or the inertia not positive definite.
  NewtonEuler(double mass, const Matrix3& inertia);

  /// Accuracy: backward stable.  No allocation.
  [[nodiscard]] Acceleration acceleration(const Vector3& angular_velocity, const BodyWrench& wrench) const;

 private:
  double mass_;
  Matrix3 inertia_;
  Eigen::LLT<Matrix3> factors_;
};

}  // namespace clatter::numeric
