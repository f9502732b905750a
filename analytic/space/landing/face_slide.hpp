// SPDX-License-Identifier: GPL-3.0-or-later
// A level face that slides and spins on level ground under its weight until friction stops both.
//
// In axes that turn with the body, U the velocity of the centre of mass, w the spin and P = m g t:
//     m dU/dP = F − m w/(m g) ẑ × U,   I_zz dw/dP = K,   dψ/dP = w/(m g),   dx/dP = R(ψ) U/(m g),          (1)
// F, K as in face_friction.hpp with the pressure that carries the weight and holds the tilt (τ = 0).  Slide and spin
// end together.
#pragma once

#include <optional>

#include "analytic/space/impulse/contact_area.hpp"

namespace clatter::analytic::space {

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

/// By (1) up to the time, or the stop before it; nothing where pressure does not stay inside the area.
/// @param area  from below the centre of mass, axes of the beginning
/// Accuracy: 1e-12 of time, way and turn until the stop.
[[nodiscard]] std::optional<SlidFace> slide_and_spin(const SpinningFace& face, const ContactArea& area, double until);

}  // namespace clatter::analytic::space
