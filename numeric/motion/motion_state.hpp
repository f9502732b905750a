// SPDX-License-Identifier: GPL-3.0-or-later
// Position, attitude and velocity of a rigid body.
#pragma once

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

/// World frame: x right, y into the page, z up, ground at z = 0.  Body frame: axes of the mesh, origin at the
/// centre of mass.  `attitude` holds the Euler parameters (β₀; β₁, β₂, β₃) as (w; x, y, z) of a unit quaternion and
/// takes body to world coordinates: x = centre + A(β) u′.
struct MotionState {
  Vector3 centre = Vector3::Zero();                              ///< of mass, world [m]
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< body → world
  Vector3 velocity = Vector3::Zero();                            ///< of the centre of mass, world [m/s]
  Vector3 angular_velocity = Vector3::Zero();                    ///< body frame [rad/s]
};

/// Acceleration of free fall, in the axes of the ground.
struct Gravity {
  double down = 0;   ///< towards the ground, >= 0 [m/s²]
  double along = 0;  ///< along x, where the ground slopes [m/s²]

  // NOLINTNEXTLINE(google-explicit-constructor): of level ground it is a number
  Gravity(double towards, double along_ground = 0) : down(towards), along(along_ground) {}
  [[nodiscard]] Vector3 acceleration() const { return {along, 0, -down}; }
  /// Potential energy [J].
  [[nodiscard]] double potential(double mass, const Vector3& centre) const {
    return mass * down * centre.z() - mass * along * centre.x();
  }
};

/// Attitude and body-frame angular velocity at an instant.
struct Rotation {
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< body → world, unit
  Vector3 angular_velocity = Vector3::Zero();                    ///< body frame [rad/s]
};

}  // namespace clatter::numeric
