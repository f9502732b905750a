// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/start.hpp"

#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {

Eigen::Quaterniond attitude_of(const Drop& drop) {
  return Eigen::AngleAxisd(-drop.inclination, Vector3::UnitY()) *
         Eigen::AngleAxisd(drop.out_of_plane_tilt, Vector3::UnitX());
}

MotionState on_ground(const Body& body, MotionState state) {
  state.attitude.normalize();
  state.centre.setZero();
  state.centre.z() = -lowest_height(body, state);
  return state;
}

MotionState touching_state(const Body& body, const Drop& drop) {
  MotionState state;
  state.attitude = attitude_of(drop);
  state.velocity = drop.velocity;
  state.angular_velocity = state.attitude.conjugate() * Vector3(0, drop.spin, 0);
  return on_ground(body, state);
}

}  // namespace clatter::numeric
