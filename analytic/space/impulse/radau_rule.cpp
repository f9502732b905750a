// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/radau_rule.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

namespace clatter::analytic::space {

namespace {

/// P_0 … P_n.
template <std::size_t count>
std::array<double, count> legendre(double x) {
  std::array<double, count> p{1, x};
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const auto n = static_cast<double>(k);
    p[k + 1] = ((2 * n + 1) * x * p[k] - n * p[k - 1]) / (n + 1);
  }
  return p;
}

}  // namespace

RadauRule::RadauRule() {
  constexpr auto s = static_cast<std::size_t>(points);
  Eigen::Matrix<double, points, points> values, integrals;
  for (int i = 0; i < points; ++i) {
    // The zeros of P_s − P_{s−1}, by Newton's method from those of a Chebyshev polynomial; the last is 1.
    double x = -std::cos(std::numbers::pi * (2 * i + 1) / (2 * points - 1));
    if (i == points - 1) x = 1;
    for (int k = 0; k < 50 && i < points - 1; ++k) {
      const auto p = legendre<s + 1>(x);
      const double n = points, scale = x * x - 1;
      const double slope = (n * (x * p[s] - p[s - 1]) - (n - 1) * (x * p[s - 1] - p[s - 2])) / scale;
      x -= (p[s] - p[s - 1]) / slope;
    }
    at[i] = (1 + x) / 2;
    const auto p = legendre<s + 1>(x);
    for (std::size_t k = 0; k < s; ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      values(i, column) = p[k];
      integrals(i, column) = k == 0 ? (1 + x) / 2 : (p[k + 1] - p[k - 1]) / (2 * (2 * static_cast<double>(k) + 1));
    }
  }
  const Eigen::Matrix<double, points, points> coefficients = values.inverse();
  weight = integrals * coefficients;
  highest = coefficients.row(points - 1);
}

}  // namespace clatter::analytic::space
