// SPDX-License-Identifier: GPL-3.0-or-later
// How a body that bounces no more moves on, in closed form.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// A body that the ground carries and that nothing moves.
struct Equilibrium {
  MotionState state;         ///< without velocities
  double depth = 0;          ///< of its deepest point below the ground [m]
  double energy_stored = 0;  ///< in the ground's springs [J]
};

/// What becomes of a body on the ground.
enum class GroundMotionKind {
  rests,   ///< at once, or after it has slid on until friction stops it
  slides,  ///< on for ever
  spins,   ///< on, about the vertical
  rolls,   ///< on, about a horizontal axis; where the ground's dampers slow it, ever slower
};

/// A motion on the ground from `from` on, straight, about an axis that stays. Until `stops_after`
///     x(t) = x₀ + v s(λ, t) + a t²/2,   A(t) = R(ω, |ω| s(κ, t)) A₀,   s(λ, t) = (1 − exp(−λt))/λ,
/// with a or λ zero; then it lies as `rest` says.
struct GroundMotion {
  GroundMotionKind kind = GroundMotionKind::rests;
  MotionState from;                        ///< without what is left of vertical motion and tipping
  Vector3 acceleration = Vector3::Zero();  ///< a, along the ground [m/s²]
  double decay = 0, turning_decay = 0;     ///< λ and κ [1/s]
  double stops_after = std::numeric_limits<double>::infinity();  ///< of a body that comes to rest [s]
  Equilibrium rest;                                              ///< there
  Vector3 force = Vector3::Zero();                               ///< of the ground before that, world [N]
  double energy_stored = 0;                                      ///< in its springs before that [J]
  Vector3 rest_force = Vector3::Zero();                          ///< of the ground after it [N]
  double left_speed = 0;    ///< of the vertical motion and sliding that `from` leaves out [m/s]
  double left_turning = 0;  ///< of the tipping and spinning that it leaves out [rad/s]
  double left_time = 0;     ///< in which that dies away or turns back, about [s]
  bool rocks = false;       ///< whether that goes on for long, of a size that counts: see RockingWatch

  /// After `time` [s], at least 0.
  [[nodiscard]] MotionState at(double time) const {
    const auto slowed = [&](double rate) { return rate > 0 ? -std::expm1(-rate * time) / rate : time; };
    if (!(time < stops_after)) return rest.state;
    MotionState state = from;
    state.centre += slowed(decay) * from.velocity + time * time / 2 * acceleration;
    state.velocity = from.velocity * std::exp(-decay * time) + time * acceleration;
    const double speed = from.angular_velocity.norm();
    if (speed > 0) {
      const double angle = std::remainder(speed * slowed(turning_decay), 2 * std::numbers::pi);
      state.attitude = (from.attitude * Eigen::AngleAxisd(angle, from.angular_velocity / speed)).normalized();
      state.angular_velocity *= std::exp(-turning_decay * time);
    }
    return state;
  }
};

}  // namespace clatter::numeric
