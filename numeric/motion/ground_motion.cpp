// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/ground_motion.hpp"

#include <cmath>
#include <numbers>

namespace clatter::numeric {
namespace {

/// (1 − exp(−λt))/λ.
double slowed(double decay, double time) { return decay > 0 ? -std::expm1(-decay * time) / decay : time; }

}  // namespace

MotionState GroundMotion::at(double time) const {
  if (!(time < stops_after)) return rest.state;
  MotionState state = from;
  state.centre += slowed(decay, time) * from.velocity + time * time / 2 * acceleration;
  state.velocity = from.velocity * std::exp(-decay * time) + time * acceleration;
  const double speed = from.angular_velocity.norm();
  if (speed > 0) {
    const double angle = std::remainder(speed * slowed(turning_decay, time), 2 * std::numbers::pi);
    state.attitude = (from.attitude * Eigen::AngleAxisd(angle, from.angular_velocity / speed)).normalized();
    state.angular_velocity *= std::exp(-turning_decay * time);
  }
  return state;
}

}  // namespace clatter::numeric
