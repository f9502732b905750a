// SPDX-License-Identifier: GPL-3.0-or-later
// How a body's free rotation changes with its start, in closed form but for one integral.
//
// Errors δθ (rotation vector of the attitude's error) and δω in the world frame, L the momentum, I the inertia in world
// axes: δL = I δω + δθ × L − I (δθ × ω) is kept, so that
//     δω = I⁻¹ (δL − δθ × L) + δθ × ω.                                                               (1)
// A longer L in its direction runs the same motion faster; one turned by κ = m × δL/|L| (m = L/|L|) is the motion
// turned by κ from a start turned by −κ.  With H of turn_growth() and δθ(0) = 0,
//     δθ(t) = (1 − H) κ + t ω(t) m·δL/|L|.                                                           (2)
#pragma once

#include "analytic/space/flight/body.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/flight/free_flight.hpp"

namespace clatter::analytic::space {

/// H: a small turn κ of the body at t = 0, its momentum kept, is the turn H κ at `time`; world frame.
/// Let ω = ω_m m − ω_p p with p ⟂ m and ω_p > 0, n = p × m, and ψ = ω_p(0)/ω_p.  Turns about the momentum, along the
/// motion, and across both, whose part in n follows from the energy, give
///     H m = m,   H p(0) = p/ψ,   H n(0) = ψ n − t ω_p(0) m − (B/ψ) p,   B = |L| ∫ ψ² (n·I⁻¹n − p·I⁻¹p) dt,      (3)
/// p and n at `time`.  In the notation of free_flight.hpp (1), with a_i = |L|/I_i, w = M₁² M₃² (a₁ − a₃)² and
/// c = M₃² (a₁ − a₃) (a₂ − a₃),
///     B = ω_p(0)² [w u − c² k² sn u cn u dn u/ω_p² − c k² ∫ sn² u du]/[λ w M₃² (a₂ − a₃) k′²]                  (4)
/// between u₀ and u; its derivative is B's by the algebra of Jacobi's functions.  About a fixed axis, β = Aᵀ H κ obeys
/// β̇ = M β, M = I⁻¹ [L]× − [ω]× in body axes, and M³ = −ν² M.
/// @param inertia  of the body, body axes [kg·m²]
/// Accuracy: 1e-11 of the largest element.
[[nodiscard]] Matrix3 turn_growth(const FreeRotation& rotation, const Matrix3& inertia, double time);

/// Changes of attitude and angular velocity at a time, for a change of the angular velocity at t = 0.
struct RotationDerivatives {
  Matrix3 attitude;          ///< ∂θ/∂ω(0) [s]
  Matrix3 angular_velocity;  ///< ∂ω/∂ω(0)
};
/// (2) and (1).  Accuracy: 1e-10 of the largest element of each.
[[nodiscard]] RotationDerivatives rotation_derivatives(const FreeFlight& flight, const Matrix3& inertia, double time);

/// Changes of the state at the touch that ends a flight, and of the flight's time, for changes of the state at its
/// start: (t, δθ, δV, δω), world frame.
struct ArrivalDerivatives {
  Eigen::Matrix<double, 10, 10> of_state;
  Eigen::Matrix<double, 1, 10> of_time;
};
/// Changes of the state at `time` after the start of a flight, by rotation_derivatives(), where that time shifts by
/// `of_time` with the state at its start: by −1 with the first number where the clock has not its error.
/// @param now  flight.at(time)
[[nodiscard]] Eigen::Matrix<double, 10, 10> flight_derivatives(const Body& body, const FreeFlight& flight, double time,
                                                               const State& now,
                                                               const Eigen::Matrix<double, 1, 10>& of_time);
/// By rotation_derivatives() at a fixed time; the touch at h = 0 then shifts the time by
///     δt = −δh/h′,   δh = −(δθ₀ × r₀)_z + t δV_z + (δθ₁ × r₁)_z,                                        (5)
/// r₀, r₁ from the centre of mass to the point that departed, at height 0, and to the one that arrives.
/// @param now       flight.at(contact.time)
/// @param from, to  these points, body frame
[[nodiscard]] ArrivalDerivatives arrival_derivatives(const Body& body, const FreeFlight& flight,
                                                     const FirstContact& contact, const State& now, const Vector3& from,
                                                     const Vector3& to);

}  // namespace clatter::analytic::space
