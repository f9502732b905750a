// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers in which a body moves some corners of which stay on the ground.
#pragma once

#include <span>

#include "analytic/space/sequence/ground_forces.hpp"

namespace clatter::analytic::space {

/// Attitude (w, x, y, z), angular velocity, horizontal velocity and place of the first corner on the ground.
using GroundMotion = Eigen::Matrix<double, 11, 1>;

/// The velocity of the first corner along the ground.
[[nodiscard]] inline auto slip_in(GroundMotion& y) { return y.segment<2>(7); }
[[nodiscard]] inline Vector3 slip_in(const GroundMotion& y) { return {y[7], y[8], 0}; }

[[nodiscard]] State state_of(const GroundMotion& y, std::span<const GroundPoint> points);

/// Their rate of change under these forces; that of a first corner that sticks is zero.
[[nodiscard]] GroundMotion rate_of(const GroundMotion& y, std::span<const GroundPoint> points, const GroundForces& f);

/// Velocity of a corner along the ground: that of the first to its last digit, however small [m/s].
[[nodiscard]] Vector3 slip_of(const GroundMotion& y, std::span<const GroundPoint> points, const GroundPoint& point);

/// The sizes by which changes are judged.
struct MotionScale {
  double reach;  ///< [m]
  double speed;  ///< [m/s]

  /// The largest of the changes of attitude and velocities, each over its size; the place of the corner decides
  /// nothing.
  [[nodiscard]] double largest(const GroundMotion& change) const;
};

}  // namespace clatter::analytic::space
