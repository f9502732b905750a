// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors and matrices of the simulator.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace clatter::numeric {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// ã, the matrix with ã b = a × b.
[[nodiscard]] inline Matrix3 skew(const Vector3& a) {
  Matrix3 matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

}  // namespace clatter::numeric
