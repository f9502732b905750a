// SPDX-License-Identifier: GPL-3.0-or-later
// Coulomb friction spread over the area of a level face that rebounds as a whole.
//
// The normal motion is prescribed: while the normal impulse P grows to N, dω_h/dP = τ, ω_h = (ω_x, ω_y).  In each dP
// the ground pushes with q(x) dP, q = max(0, a + b x + c y), ∫q dA = 1, and rubs with −μ q d dP, d the direction of
// slip at x, measured from below the centre of mass.  With F = −μ ∫q d dA, K = −μ ∫q x × d dA and h the depth of the
// ground, U = V_h + h (−ω_y, ω_x) the slip below the centre of mass and w = ω_z obey
//     m dU/dP = F + m h (−τ_y, τ_x),   J dw/dP = K + J α₀,                                             (1)
// J = 1/(I⁻¹ − I⁻¹ E I⁻¹)_zz and α₀ = (I⁻¹ E τ)_z with E = [(I⁻¹)_hh]⁻¹: the body turned about the vertical while its
// ω_h is given.  a, b, c follow from F, K by
//     ∫q x dA = (−M_y, M_x) − h F,   M = E (τ − (I⁻¹)_hz K),                                          (2)
// the moment that turns the body so; q is positive on a part of the area alone where (2) lies outside its kernel.
// F and K depend on the direction of (U, w) alone, and slide and spin end together.  Thereafter the face sticks if
// friction can hold it under the pressure that it then has, or slip goes on.
//
// Where (2) asks for a point R outside the area, the ground pushes at the point x̂ of FacePressure, and the moment
// of the rest tilts the body.  With B from the slopes of its normal velocities, B = Tᵀ (I⁻¹)_hh T, T the quarter turn,
//     d(U, w)/dP of (1) grows by Sᵀ B (R − x̂),   dω_h/dP = τ + (I⁻¹)_hh T (R − x̂),                     (3)
// and while the face sticks x̂ is the point nearest to R in the metric of the tilt about points that stay.
#pragma once

#include <optional>

#include "analytic/space/impulse/contact_area.hpp"
#include "analytic/space/impulse/impulse_path.hpp"

namespace clatter::analytic::space {

/// A face while it lands, world axes.
struct SlidingFace {
  double mass = 1;                                ///< m [kg]
  Matrix3 inverse_inertia = Matrix3::Identity();  ///< I⁻¹ [1/(kg·m²)]
  double depth = 0;                               ///< h [m]
  double friction = 0;                            ///< μ > 0
  double normal_impulse = 1;                      ///< N [N·s]
  Vector2 turn_rate = Vector2::Zero();            ///< τ [1/(kg·m·s) · s]
  Vector2 slip = Vector2::Zero();                 ///< U before [m/s]
  double spin = 0;                                ///< ω_z before [rad/s]
  double velocity_scale = 0;                      ///< rounding errors of U are below 4ε × this [m/s]
};

/// What friction does to a face.
struct FaceFriction {
  Vector2 impulse = Vector2::Zero();  ///< ∫F dP [N·s]
  double couple = 0;                  ///< ∫K dP, about the vertical through the centre of mass [N·m·s]
  Vector2 moment = Vector2::Zero();   ///< of the pushes beside that of the rebound as a whole [N·m·s]
  double spin_after = 0;              ///< ω_z [rad/s]
  bool has_pressure = true;           ///< false: it asks for pushes outside the area, as it does without friction
  double path_error = 0;              ///< of the impulse, relative, where pushes have come to the boundary of the area
  PathKind path = PathKind::turning_slip;
};

/// Whether all of the face slips, or is about to, in one direction to rounding, through the pressure point, which stays
/// inside: friction then has no couple, and all of it may as well act below the centre of mass.
[[nodiscard]] bool slides_straight(const SlidingFace& face, const ContactArea& area);

/// Friction of a face.
/// Accuracy: 1e-12 of μN and of what (U, w) does to m, J; where it tilts, FaceFriction::path_error.
[[nodiscard]] FaceFriction face_friction(const SlidingFace& face, const ContactArea& area);

// A level face that slides and spins on level ground under its weight until friction stops both.
//
// In axes that turn with the body, U the velocity of the centre of mass, w the spin and P = m g t:
//     m dU/dP = F − m w/(m g) ẑ × U,   I_zz dw/dP = K,   dψ/dP = w/(m g),   dx/dP = R(ψ) U/(m g),          (4)
// F, K as above with the pressure that carries the weight and holds the tilt (τ = 0).  Slide and spin
// end together.

struct SpinningFace {
  double mass = 1;                 ///< m [kg]
  double moment = 1;               ///< I_zz about the vertical, which is a principal axis [kg·m²]
  double depth = 0;                ///< of the ground below the centre of mass [m]
  double friction = 0;             ///< μ > 0
  double gravity = 0;              ///< g > 0 [m/s²]
  Vector2 slip = Vector2::Zero();  ///< U [m/s]
  double spin = 0;                 ///< w [rad/s]
};

/// Where it is at a time.
struct SlidFace {
  double time = 0;                 ///< since it began, or when it stopped if that is earlier [s]
  bool has_stopped = false;        ///< until then
  Vector2 way = Vector2::Zero();   ///< of the centre of mass, axes of the beginning [m]
  double turn = 0;                 ///< ψ [rad]
  Vector2 slip = Vector2::Zero();  ///< axes of the beginning [m/s]
  double spin = 0;                 ///< [rad/s]
};

/// By (4) up to the time, or the stop before it; nothing where pressure does not stay inside the area.
/// @param area  from below the centre of mass, axes of the beginning
/// Accuracy: 1e-12 of time, way and turn until the stop.
[[nodiscard]] std::optional<SlidFace> slide_and_spin(const SpinningFace& face, const ContactArea& area, double until);

}  // namespace clatter::analytic::space
