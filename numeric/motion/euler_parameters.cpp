// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/euler_parameters.hpp"

namespace clatter::numeric {

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

}  // namespace clatter::numeric
