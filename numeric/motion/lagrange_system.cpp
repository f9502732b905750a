// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/lagrange_system.hpp"

#include <Eigen/LU>

namespace clatter::numeric {

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
