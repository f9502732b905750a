// SPDX-License-Identifier: GPL-3.0-or-later
// Free flight in closed form, the next touch-down, and where the body then touches the ground.
#pragma once

#include "numeric/body/body.hpp"
#include "numeric/motion/free_rotation.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// A parabola of the centre of mass and a torque-free rotation about it.
class FreeFlight {
 public:
  /// A planar flight turns about the axis of `start`'s angular velocity, whatever the inertia.
  FreeFlight(const Body& body, const MotionState& start, const Gravity& gravity, bool planar = false);

  /// State after `time` [s], of either sign.
  [[nodiscard]] MotionState at(double time) const;
  /// Towards the ground [m/s²].
  [[nodiscard]] double gravity() const { return gravity_.down; }
  /// Bound on the vertical acceleration of a point at distance 1 m from the centre of mass [1/s²].
  [[nodiscard]] double turning_acceleration() const;

 private:
  MotionState start_;
  Gravity gravity_;
  FreeRotation rotation_;
};

struct TouchDown {
  enum class Kind {
    touch,      ///< a vertex reaches the ground at `time`
    never,      ///< proved: no vertex reaches it any more
    undecided,  ///< the search used up its evaluations at `time`
  };
  Kind kind = Kind::never;
  double time = 0;       ///< after the start of the flight [s]
  long evaluations = 0;  ///< of the pose
};

/// The earliest time from 0 at which a vertex of the body, above the ground or leaving it at the start, reaches it.
/// Each step of the search is as long as the lower bound
///     height(t + τ) ≥ height(t) + τ d/dt height(t) − τ²/2 (g + (|ω|²max + |ω̇|max) |u|)
/// proves every vertex to stay above the ground, so no earlier contact is missed; near the root the steps
/// converge quadratically.  Vertices within 4 ulp of the body's size above the ground touch.  Of a smooth shape the
/// same holds for the lowest point of each end, wherever that moves to on it.
[[nodiscard]] TouchDown next_touch_down(const Body& body, const FreeFlight& flight, long evaluation_limit = 300'000);

/// The lowest vertex, or point of a smooth shape, body frame; any of several.
[[nodiscard]] Vector3 lowest_vertex(const Body& body, const MotionState& state);
/// Its height above the ground [m].
[[nodiscard]] double lowest_height(const Body& body, const MotionState& state);

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

/// Translational + rotational + potential (m g z) energy [J].
[[nodiscard]] double mechanical_energy(const Body& body, const MotionState& state, const Gravity& gravity);

/// The state without what rounding has put out of the plane of motion, world x and z.
[[nodiscard]] MotionState in_plane(const MotionState& state);

/// Velocity of the body's point u, world [m/s].
[[nodiscard]] inline Vector3 point_velocity(const MotionState& state, const Vector3& u) {
  return state.velocity + state.attitude * state.angular_velocity.cross(u);
}

}  // namespace clatter::numeric
