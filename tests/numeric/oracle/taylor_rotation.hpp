// Torque-free rotation by Taylor series of Euler's equations and of the quaternion, in any precision.
#pragma once

#include <array>
#include <cmath>

namespace clatter::oracle {

template <typename Real>
struct RotationState {
  std::array<Real, 3> omega{};                     ///< along the principal axes
  std::array<Real, 4> attitude{Real(1), 0, 0, 0};  ///< w, x, y, z
};

/// One step: recurrences for the coefficients of order 0 to `order`, then Horner's rule.  With steps of half a
/// radian the series converges like 2⁻ⁿ or better.
template <typename Real, int order>
RotationState<Real> taylor_step(const std::array<Real, 3>& moments, const RotationState<Real>& state,
                                const Real& step) {
  std::array<std::array<Real, order + 1>, 3> w;
  std::array<std::array<Real, order + 1>, 4> q;
  for (int i = 0; i < 3; ++i) w[i][0] = state.omega[i];
  for (int i = 0; i < 4; ++i) q[i][0] = state.attitude[i];
  for (int n = 0; n < order; ++n) {
    const auto product = [n](const auto& a, const auto& b) {
      Real sum = 0;
      for (int k = 0; k <= n; ++k) sum += a[k] * b[n - k];
      return sum;
    };
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      w[i][n + 1] = (moments[j] - moments[k]) / moments[i] * product(w[j], w[k]) / (n + 1);
      q[i + 1][n + 1] = (product(q[0], w[i]) + product(q[j + 1], w[k]) - product(q[k + 1], w[j])) / (2 * (n + 1));
    }
    q[0][n + 1] = -(product(q[1], w[0]) + product(q[2], w[1]) + product(q[3], w[2])) / (2 * (n + 1));
  }
  const auto value = [&step](const auto& series) {
    Real sum = series[order];
    for (int k = order - 1; k >= 0; --k) sum = sum * step + series[k];
    return sum;
  };
  RotationState<Real> result;
  for (int i = 0; i < 3; ++i) result.omega[i] = value(w[i]);
  for (int i = 0; i < 4; ++i) result.attitude[i] = value(q[i]);
  return result;
}

}  // namespace clatter::oracle
