// SPDX-License-Identifier: GPL-3.0-or-later
// Free flight of a body in space: a parabola and a torque-free rotation.
#pragma once

#include "analytic/space/free_rotation.hpp"

namespace clatter::analytic::space {

/// Motion without contact from a state at t = 0.
class FreeFlight {
 public:
  /// @param gravity g >= 0, downward [m/s²]
  FreeFlight(const PrincipalAxes& principal, const State& start, double gravity)
      : start_(start), gravity_(gravity), rotation_(principal, start.attitude, start.angular_velocity) {}

  [[nodiscard]] State at(double time) const;
  /// Height of the centre of mass and its velocity at a time.
  [[nodiscard]] double centre_height(double t) const {
    return start_.position.z() + t * (start_.velocity.z() - gravity_ / 2 * t);
  }
  [[nodiscard]] double centre_velocity(double t) const { return start_.velocity.z() - gravity_ * t; }
  /// Last time at which the centre of mass is at this height on its way down; infinite if it never is, 0 if that lies
  /// in the past [s].
  [[nodiscard]] double falls_through(double height) const;
  /// First time at which the centre of mass is at this height on its way up; 0 if it starts above, infinite if never.
  [[nodiscard]] double rises_through(double height) const;

  [[nodiscard]] const State& start() const { return start_; }
  [[nodiscard]] double gravity() const { return gravity_; }
  [[nodiscard]] const FreeRotation& rotation() const { return rotation_; }

 private:
  State start_;
  double gravity_;
  FreeRotation rotation_;
};

}  // namespace clatter::analytic::space
