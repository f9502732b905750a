// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace clatter::numeric {
namespace {

// Quadrature over a fine mesh leaves this much, relative to the largest moment.
constexpr double input_rounding = 1e-10;

[[noreturn]] void refuse(const Matrix3& inertia, const std::string& constraint) {
  const Eigen::IOFormat row_by_row(6, Eigen::DontAlignCols, ", ", "; ", "", "", "[", "]");
  std::ostringstream message;
  message << "inertia = " << inertia.format(row_by_row) << ": " << constraint;
  throw std::domain_error(message.str());
}

PrincipalAxes of_diagonal(const Vector3& moments) {
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int j) { return moments[i] < moments[j]; });
  PrincipalAxes result;
  for (int i = 0; i < 3; ++i) {
    result.moments[i] = moments[order[i]];
    result.axes.col(i) = Vector3::Unit(order[i]);
  }
  return result;
}

/// The power of two keeps products of the tensor's elements within range, and costs no rounding.
PrincipalAxes of_full(const Matrix3& inertia, double largest) {
  const int exponent = std::ilogb(largest);
  const Matrix3 scaled = inertia.unaryExpr([&](double x) { return std::ldexp(x, -exponent); });
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver((scaled + scaled.transpose()) / 2);
  return {.moments = solver.eigenvalues().unaryExpr([&](double x) { return std::ldexp(x, exponent); }),
          .axes = solver.eigenvectors()};
}

}  // namespace

PrincipalAxes principal_axes(const Matrix3& inertia) {
  if (!inertia.allFinite()) refuse(inertia, "must be finite");
  const double largest = inertia.cwiseAbs().maxCoeff();
  if (!((inertia - inertia.transpose()).cwiseAbs().maxCoeff() <= input_rounding * largest)) {
    refuse(inertia, "must be symmetric");
  }
  PrincipalAxes result = inertia.isDiagonal(0) ? of_diagonal(inertia.diagonal()) : of_full(inertia, largest);
  const Vector3& moments = result.moments;
  if (!(moments[0] > 0)) refuse(inertia, "must be positive definite");
  if (!(moments[2] - moments[1] <= moments[0] + input_rounding * moments[2])) {
    refuse(inertia, "largest principal moment must not exceed the sum of the others");
  }
  if (result.axes.determinant() < 0) result.axes.col(1) *= -1;
  return result;
}

}  // namespace clatter::numeric
