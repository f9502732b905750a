// SPDX-License-Identifier: GPL-3.0-or-later
// How a drop begins.
#pragma once

#include "numeric/body/body.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// How the body is dropped: attitude and velocity when its lowest point first touches.
struct Drop {
  double inclination = 0;  ///< of the body's x axis [rad]: rotation about −y from the mesh's own attitude
  Vector3 velocity = -Vector3::UnitZ();  ///< of the centre of mass, world [m/s]
  double spin = 0;                       ///< Ω = ω_y [rad/s]
  double out_of_plane_tilt = 0;          ///< rotation about the body's x axis, before the inclination [rad]
};

/// Body → world of a drop.
[[nodiscard]] Eigen::Quaterniond attitude_of(const Drop& drop);

/// The state with the centre of mass above x = y = 0 and the lowest vertex on z = 0; its attitude may have any length
/// but 0, and gets 1.
[[nodiscard]] MotionState on_ground(const Body& body, MotionState state);

/// State at the first touch, on the ground as on_ground has it.
[[nodiscard]] MotionState touching_state(const Body& body, const Drop& drop);

}  // namespace clatter::numeric
