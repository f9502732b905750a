// SPDX-License-Identifier: GPL-3.0-or-later
// Attitude and angular velocity of a rigid body.
#pragma once

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

/// Attitude and body-frame angular velocity at an instant.
struct Rotation {
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< body → world, unit
  Vector3 angular_velocity = Vector3::Zero();                    ///< body frame [rad/s]
};

}  // namespace clatter::numeric
