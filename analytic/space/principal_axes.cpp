// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace clatter::analytic::space {
namespace {

bool is_diagonal(const Matrix3& m) { return m(0, 1) == 0 && m(0, 2) == 0 && m(1, 2) == 0; }

}  // namespace

PrincipalAxes::PrincipalAxes(const Matrix3& inertia) {
  if (is_diagonal(inertia)) {
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return inertia(i, i) < inertia(j, j); });
    for (int k = 0; k < 3; ++k) {
      const int from = order[static_cast<std::size_t>(k)];
      moments[static_cast<std::size_t>(k)] = inertia(from, from);
      axes.col(k) = Matrix::Identity().col(from);
    }
  } else {
    const Matrix symmetric = inertia.cast<long double>().selfadjointView<Eigen::Lower>();
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric);
    for (int k = 0; k < 3; ++k) moments[static_cast<std::size_t>(k)] = solver.eigenvalues()[k];
    axes = solver.eigenvectors();
  }
  if (axes.determinant() < 0) axes.col(1) = -axes.col(1);
}

}  // namespace clatter::analytic::space
