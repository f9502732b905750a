// SPDX-License-Identifier: GPL-3.0-or-later
// Motions on the ground that go on as they are, in closed form.
#pragma once

#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// How a body that bounces no more moves on.
enum class GroundMotionKind { rests, slides, spins, rolls };

/// A motion on the ground with a constant acceleration along it and a constant angular velocity, from `from` on:
///     x(t) = x₀ + v t + a t²/2,   A(t) = R(ω, |ω| t) A₀.
struct GroundMotion {
  GroundMotionKind kind = GroundMotionKind::rests;
  MotionState from;  ///< without what is left of vertical motion and tipping
  Vector3 acceleration = Vector3::Zero();
  Vector3 force = Vector3::Zero();  ///< of the ground, world [N]
  double energy_stored = 0;         ///< in the ground's springs [J]
  double left_speed = 0;            ///< of the vertical motion and sliding that `from` leaves out [m/s]
  double left_turning = 0;          ///< of the tipping and spinning that it leaves out [rad/s]
  double left_time = 0;             ///< in which that dies away or turns back, about [s]

  /// After `time` [s], at least 0.
  [[nodiscard]] MotionState at(double time) const;
};

}  // namespace clatter::numeric
