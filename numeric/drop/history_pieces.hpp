// SPDX-License-Identifier: GPL-3.0-or-later
// The dense history of a simulated drop: pieces in which nothing jumps, each with samples that a polynomial fits.
#pragma once

#include <span>

#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// Samples of a piece lie at the Chebyshev points of the second kind: a polynomial through them stands for all of it.
inline constexpr int piece_points = 9;
/// x_j = (1 − cos(π j/(piece_points − 1)))/2, in [0, 1].
[[nodiscard]] double piece_point(int j);

/// One instant, with what a point of the body needs to be told its acceleration.
struct PieceSample {
  MotionState state;
  Vector3 force = Vector3::Zero();                 ///< of contact, world [N]
  Vector3 angular_acceleration = Vector3::Zero();  ///< ω̇′ of the equations of motion, body frame [rad/s²]
};

/// An accepted step of a contact, or a part of a flight.
struct HistoryPiece {
  int impact = 0;  ///< of the contact, from 1; of a flight, that of the impact before it
  bool in_contact = false;
  double origin = 0;  ///< touch-down of the contact, or beginning of the flight, after the first touch-down [s]
  double start = 0;   ///< of the piece, after that [s]
  double length = 0;  ///< [s]
  std::span<const PieceSample> samples;  ///< at start + piece_point(j) × length, each by the method of integration
};

}  // namespace clatter::numeric
