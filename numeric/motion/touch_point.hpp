// SPDX-License-Identifier: GPL-3.0-or-later
// Where a body touches the ground.
#pragma once

#include "numeric/body/body.hpp"
#include "numeric/body/contact_end.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// Mean of the vertices that touch the ground at the same time: lowest to within 1e-11 of the body's radius.
/// Body frame.
[[nodiscard]] Vector3 touch_point(const Body& body, const MotionState& state);

/// The vertices that touch_point averages: which ends of the body they are, and how fast the fastest of them comes
/// down.
struct FirstTouch {
  ContactEnd end = ContactEnd::middle;
  double approach_speed = 0;  ///< [m/s]; not positive: no vertex there approaches the ground
};
[[nodiscard]] FirstTouch first_touch(const Body& body, const MotionState& state);

/// Velocity of the body's point u, world [m/s].
[[nodiscard]] inline Vector3 point_velocity(const MotionState& state, const Vector3& u) {
  return state.velocity + state.attitude * state.angular_velocity.cross(u);
}

}  // namespace clatter::numeric
