// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/steady_motion.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::numeric {
namespace {

/// Part of the speed and acceleration of a fall below which a body lies still.
constexpr double least_rest = 1e-6, largest_rest = 1e-5;

/// Whether the body slides down a slope that friction cannot hold it on, ever faster.
bool slides_down(const ContactSystem& system, const ContactInstant& at) {
  const double along = system.gravity_along();
  return std::fabs(along) > system.ground().sliding_friction * system.gravity() && velocity(at.state).x() * along > 0;
}

/// Acceleration along the ground that lasts for ever.
Vector3 sliding_acceleration(const ContactSystem& system, const ContactInstant& at) {
  if (!slides_down(system, at)) return Vector3::Zero();
  const double along = system.gravity_along();
  return {along - std::copysign(system.ground().sliding_friction * system.gravity(), along), 0, 0};
}

bool is_steady(const ContactSystem& system, const ContactInstant& at, double kept_up) {
  const double g = system.gravity();
  const double depth = at.diagnosis.load.deepest;
  if (!(g > 0) || !(depth > 0)) return false;
  const double radius = system.body().radius(), fall = std::sqrt(g * depth);
  const double part = std::clamp(kept_up / fall, least_rest, largest_rest);
  const double turning = angular_velocity(at.state).norm(), spin = at.diagnosis.spin;
  const double tipping = std::sqrt(std::max(turning * turning - spin * spin, 0.0));
  return std::fabs(velocity(at.state).z()) <= part * fall &&
         radius * tipping <= part * fall + 1e-7 * radius * turning &&
         (velocity(at.rate) - sliding_acceleration(system, at)).norm() <= part * g &&
         radius * angular_velocity(at.rate).norm() <= part * g;
}

/// Sliding without friction or down a slope, or spinning about the pressure centre of a patch that counts as a point.
bool goes_on_for_ever(const ContactSystem& system, const ContactInstant& at) {
  return slides_down(system, at) || system.ground().sliding_friction == 0 ||
         (system.phase().kind == FrictionPhase::Kind::stick && system.phase().point);
}

GroundMotion motion_from(const ContactSystem& system, const ContactInstant& at, GroundMotionKind kind) {
  GroundMotion motion{.kind = kind, .from = system.motion(at.state)};
  const Vector3 up = motion.from.attitude.conjugate() * Vector3::UnitZ();
  Vector3& velocity = motion.from.velocity;
  Vector3& turning = motion.from.angular_velocity;
  const MotionState before = motion.from;
  velocity.z() = 0;
  turning = at.diagnosis.spin * up;
  if (kind == GroundMotionKind::rests) {
    velocity.setZero();
    turning.setZero();
  }
  motion.left_speed = (before.velocity - velocity).norm();
  motion.left_turning = (before.angular_velocity - turning).norm();
  motion.left_time = std::sqrt(at.diagnosis.load.deepest / system.gravity());
  motion.acceleration = kind == GroundMotionKind::rests ? Vector3::Zero() : sliding_acceleration(system, at);
  motion.force =
      system.body().mass() * (motion.acceleration - Gravity(system.gravity(), system.gravity_along()).acceleration());
  motion.energy_stored = at.diagnosis.load.energy;
  return motion;
}

}  // namespace

std::optional<GroundMotion> motion_on_the_ground(const ContactSystem& system, const ContactInstant& at,
                                                 double kept_up) {
  if (!is_steady(system, at, kept_up)) return std::nullopt;
  const double speed = least_rest * std::sqrt(system.gravity() * at.diagnosis.load.deepest);
  const double sliding = std::hypot(velocity(at.state).x(), velocity(at.state).y());
  const double turning = system.body().radius() * std::fabs(at.diagnosis.spin);
  if (sliding <= speed && turning <= speed) return motion_from(system, at, GroundMotionKind::rests);
  if (!goes_on_for_ever(system, at)) return std::nullopt;
  return motion_from(system, at, sliding > speed ? GroundMotionKind::slides : GroundMotionKind::spins);
}

}  // namespace clatter::numeric
