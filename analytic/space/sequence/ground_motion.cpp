// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/ground_motion.hpp"

#include <cmath>

namespace clatter::analytic::space {

State state_of(const GroundMotion& y, std::span<const GroundPoint> points) {
  State s;
  s.attitude = Quaternion(y[0], y[1], y[2], y[3]).normalized();
  s.angular_velocity = y.segment<3>(4);
  const Vector3 arm = s.attitude * points[0].place;
  s.velocity = slip_in(y) - s.angular_velocity.cross(arm);
  s.position = Vector3(y[9], y[10], 0) - arm;
  return s;
}

GroundMotion rate_of(const GroundMotion& y, std::span<const GroundPoint> points, const GroundForces& f) {
  const Quaternion turn(0, y[4], y[5], y[6]);
  const Quaternion change = turn * Quaternion(y[0], y[1], y[2], y[3]);
  GroundMotion result;
  result << change.w() / 2, change.vec() / 2, f.turning, f.accelerations[0].head<2>(), y[7], y[8];
  if (points[0].sticks) result.tail<4>().setZero();
  return result;
}

Vector3 slip_of(const GroundMotion& y, std::span<const GroundPoint> points, const GroundPoint& point) {
  const Vector3 from_first = Quaternion(y[0], y[1], y[2], y[3]) * (point.place - points[0].place);
  return slip_in(y) + horizontal(Vector3(y.segment<3>(4)).cross(from_first));
}

double MotionScale::largest(const GroundMotion& change) const {
  const double velocities = std::fmax(change.segment<3>(4).norm() * reach, change.segment<2>(7).norm());
  return std::fmax(change.head<4>().norm(), velocities / speed);
}

}  // namespace clatter::analytic::space
