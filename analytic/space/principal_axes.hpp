// SPDX-License-Identifier: GPL-3.0-or-later
// Principal moments and axes of a body's inertia, with more digits than a double has.
#pragma once

#include <Eigen/Core>
#include <array>

#include "analytic/space/body.hpp"

namespace clatter::analytic::space {

/// Principal moments and axes of an inertia tensor.
/// Accuracy: a few ulp of long double × the largest moment; a diagonal tensor keeps its entries as they are.
struct PrincipalAxes {
  using Matrix = Eigen::Matrix<long double, 3, 3>;

  std::array<long double, 3> moments{};  ///< ascending [kg·m²]
  Matrix axes = Matrix::Identity();      ///< columns, body frame, right-handed

  explicit PrincipalAxes(const Matrix3& inertia);
};

}  // namespace clatter::analytic::space
