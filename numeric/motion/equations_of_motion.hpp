// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of motion of a rigid body: in the form of Newton and Euler, which is stepped, and as Shan et al. (2005)
// print them, for reading and comparison.
#pragma once

#include "numeric/base/linear_algebra.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// The equations of motion of one body, which every contact is stepped with:
///     m R̈ = F,    I ω̇′ = M′ − ω′ × I ω′.
/// They are Eqs. 1 and 2 of Shan et al. (2005) without their redundant fourth parameter; see LagrangeSystem.
/// Accuracy: a few eps, of ω̇′ times the ratio of the largest to the smallest moment of inertia.  No allocation.
class NewtonEuler {
 public:
  /// `mass` [kg]; `inertia` about the centre of mass, body frame, symmetric [kg·m²].
  /// @throws std::domain_error if the mass is not positive or the inertia not that of a body (check_inertia).
  NewtonEuler(double mass, const Matrix3& inertia);

  /// R̈ by the force [m/s²].
  [[nodiscard]] Vector3 linear(const Vector3& force) const { return force / mass_; }
  /// ω̇′ by the moment and the body's own turning [rad/s²].
  [[nodiscard]] Vector3 angular(const Vector3& angular_velocity, const Vector3& moment) const {
    return response(moment - angular_velocity.cross(inertia_ * angular_velocity));
  }
  /// What a moment by itself adds to ω̇′, or an angular impulse to ω′: I⁻¹ M′.
  [[nodiscard]] Vector3 response(const Vector3& moment) const { return inverse_inertia_ * moment; }
  /// The same of a body that can only turn about the unit vector `axis` (body frame).
  [[nodiscard]] Vector3 response_about(const Vector3& axis, const Vector3& moment) const {
    return axis * (axis.dot(moment) / axis.dot(inertia_ * axis));
  }

 private:
  double mass_;
  Matrix3 inertia_, inverse_inertia_;
};

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

using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

struct BodyInertia {
  double mass = 0;                    ///< [kg]
  Matrix3 inertia = Matrix3::Zero();  ///< I′ about the centre of mass, body frame [kg·m²]
};

/// Resultant of the contact and gravity forces.
struct WorldWrench {
  Vector3 force = Vector3::Zero();   ///< F, world frame [N]
  Vector3 moment = Vector3::Zero();  ///< M_c about the centre of mass, world frame [N·m]
};

/// M q̈ = Q_v + Q_e with q = (R, β), Eq. 1.  With the origin at the centre of mass, ∫ρ u′ dΩ = 0, and the block
/// column [1; −G′ᵀ ũ′ᵀ Aᵀ] of the integrands gives
///     M   = ∫ρ [1; −G′ᵀ ũ′ᵀ Aᵀ] [1, −A ũ′ G′] dΩ       = diag(m 1, G′ᵀ I′ G′)
///     Q_v = −∫ρ [1; −G′ᵀ ũ′ᵀ Aᵀ] A ω̃′ ω̃′ u′ dΩ          = [0; −G′ᵀ (ω′ × I′ ω′)]
///     Q_e = [F; Gᵀ M_c],  G = A G′.
/// Source: Section 2 of the paper, which prints the lower block alone and ω̃′ω̃′ᵀ for ω̃′ω̃′.
struct LagrangeSystem {
  Matrix7 mass_matrix;     ///< M, symmetric, of rank 6: M (0; β) = 0 because G′ β = 0
  Vector7 velocity_force;  ///< Q_v
  Vector7 applied_force;   ///< Q_e
  Vector4 beta;            ///< β, unit
  Vector4 beta_rate;       ///< β̇ [1/s]
};
[[nodiscard]] LagrangeSystem lagrange_system(const BodyInertia& body, const MotionState& state,
                                             const WorldWrench& wrench);

struct LagrangeAcceleration {
  Vector7 coordinates;  ///< q̈ = (R̈, β̈)
  Vector3 angular;      ///< ω̇′ = G′ β̈, since Ġ′ β̇ = 0 [rad/s²]
};

/// Eq. 2.  M alone has no inverse; the second derivative of β·β = 1 makes the system regular, with the multiplier
/// μ of that constraint, which comes out as 0:
///     [ M        (0; β) ] [ q̈ ]   [ Q_v + Q_e ]
///     [ (0; β)ᵀ    0    ] [ μ ] = [ −β̇·β̇      ].
/// Accuracy: some eps times the ratio of the largest to the smallest moment of inertia.
[[nodiscard]] LagrangeAcceleration solve(const LagrangeSystem& system);

}  // namespace clatter::numeric
