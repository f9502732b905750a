// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/ground_motion.hpp"

#include <cmath>
#include <numbers>

namespace clatter::numeric {

MotionState GroundMotion::at(double time) const {
  MotionState state = from;
  state.centre += time * from.velocity + time * time / 2 * acceleration;
  state.velocity += time * acceleration;
  const double speed = from.angular_velocity.norm();
  if (speed > 0) {
    const Eigen::AngleAxisd turn(std::remainder(speed * time, 2 * std::numbers::pi), from.angular_velocity / speed);
    state.attitude = (from.attitude * turn).normalized();
  }
  return state;
}

}  // namespace clatter::numeric
