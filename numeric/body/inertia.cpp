// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/body/inertia.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "numeric/base/require.hpp"

namespace clatter::numeric {

void check_inertia(const Matrix3& inertia) {
  using detail::require;
  require(inertia.allFinite(), "inertia", inertia.sum(), "finite");
  const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  require(moments[0] > 0, "smallest principal moment of inertia", moments[0], "greater than 0");
  require(moments[2] <= (moments[0] + moments[1]) * (1 + 1e-9), "largest principal moment of inertia", moments[2],
          "at most the sum of the other two");
}

Matrix3 inverse_inertia(const Matrix3& inertia) {
  // By a power of two, which rounds nothing: the determinant of a large body's inertia overflows.
  const int exponent = std::ilogb(inertia.trace());
  const auto scaled = [](const Matrix3& m, int power) {
    return Matrix3(m.unaryExpr([&](double x) { return std::scalbn(x, power); }));
  };
  return scaled(scaled(inertia, -exponent).inverse(), -exponent);
}

}  // namespace clatter::numeric
