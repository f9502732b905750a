// SPDX-License-Identifier: GPL-3.0-or-later
// Euler parameters of an attitude, in the paper's matrices.
#pragma once

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

using Vector4 = Eigen::Vector4d;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

/// β = (β₀, β₁, β₂, β₃) = (w, x, y, z) of a quaternion.
[[nodiscard]] Vector4 euler_parameters(const Eigen::Quaterniond& attitude);

/// A(β), body → world, orthonormal for β·β = 1:
///     A = (β₀² − b·b) 1 + 2 b bᵀ + 2 β₀ b̃,   b = (β₁, β₂, β₃).
[[nodiscard]] Matrix3 rotation_matrix(const Vector4& beta);

/// G′ of the paper's Section 2, with ω′ = G′ β̇, G′ β = 0 and G′ G′ᵀ = 4 β·β 1.
[[nodiscard]] Matrix34 rate_matrix(const Vector4& beta);

/// β̇ = ½ β ω′ = ¼ G′ᵀ ω′ [1/s] for unit β and the angular velocity ω′ in the body frame [rad/s].
[[nodiscard]] inline Vector4 euler_parameter_rates(const Vector4& beta, const Vector3& angular_velocity) {
  const Vector3 b = beta.tail<3>();
  Vector4 rates;
  rates << -0.5 * b.dot(angular_velocity), 0.5 * (beta[0] * angular_velocity + b.cross(angular_velocity));
  return rates;
}

}  // namespace clatter::numeric
