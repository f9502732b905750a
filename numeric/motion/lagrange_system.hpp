// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of motion as Shan et al. (2005) print them, for reading and comparison.
#pragma once

#include "numeric/motion/euler_parameters.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

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
