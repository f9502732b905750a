// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/equations_of_motion.hpp"

#include <Eigen/LU>

#include "numeric/base/errors.hpp"
#include "numeric/body/mass_properties.hpp"

namespace clatter::numeric {

NewtonEuler::NewtonEuler(double mass, const Matrix3& inertia) : mass_(mass), inertia_(inertia) {
  detail::require_positive("mass", mass);
  check_inertia(inertia);
  inverse_inertia_ = inverse_inertia(inertia);
}

Vector4 euler_parameters(const Eigen::Quaterniond& attitude) {
  return {attitude.w(), attitude.x(), attitude.y(), attitude.z()};
}

Matrix3 rotation_matrix(const Vector4& beta) {
  const Vector3 b = beta.tail<3>();
  return (beta[0] * beta[0] - b.squaredNorm()) * Matrix3::Identity() + 2 * b * b.transpose() + 2 * beta[0] * skew(b);
}

Matrix34 rate_matrix(const Vector4& beta) {
  Matrix34 matrix;
  matrix << -beta[1], beta[0], beta[3], -beta[2], -beta[2], -beta[3], beta[0], beta[1], -beta[3], beta[2], -beta[1],
      beta[0];
  return 2 * matrix;
}

LagrangeSystem lagrange_system(const BodyInertia& body, const MotionState& state, const WorldWrench& wrench) {
  const Vector4 beta = euler_parameters(state.attitude);
  const Matrix34 g = rate_matrix(beta);
  const Vector3& omega = state.angular_velocity;

  LagrangeSystem system;
  system.mass_matrix.setZero();
  system.mass_matrix.topLeftCorner<3, 3>().diagonal().setConstant(body.mass);
  system.mass_matrix.bottomRightCorner<4, 4>() = g.transpose() * body.inertia * g;
  system.velocity_force << Vector3::Zero(), -g.transpose() * omega.cross(body.inertia * omega);
  system.applied_force << wrench.force, (rotation_matrix(beta) * g).transpose() * wrench.moment;
  system.beta = beta;
  system.beta_rate = euler_parameter_rates(beta, omega);
  return system;
}

LagrangeAcceleration solve(const LagrangeSystem& system) {
  // Row and column of the constraint in units of the inertia, so that pivots of one block compare.
  const double unit = system.mass_matrix.bottomRightCorner<4, 4>().trace();
  Eigen::Matrix<double, 8, 8> bordered;
  bordered.setZero();
  bordered.topLeftCorner<7, 7>() = system.mass_matrix;
  bordered.block<4, 1>(3, 7) = unit * system.beta;
  bordered.block<1, 4>(7, 3) = unit * system.beta.transpose();
  Eigen::Matrix<double, 8, 1> right;
  right << system.velocity_force + system.applied_force, -unit * system.beta_rate.squaredNorm();

  const Eigen::Matrix<double, 8, 1> solution = bordered.partialPivLu().solve(right);
  return {.coordinates = solution.head<7>(), .angular = rate_matrix(system.beta) * solution.segment<4>(3)};
}

}  // namespace clatter::numeric
