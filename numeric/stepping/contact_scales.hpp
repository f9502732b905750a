// SPDX-License-Identifier: GPL-3.0-or-later
// How deep, fast and long a contact is expected to be.
#pragma once

#include "numeric/contact/contact_system.hpp"

namespace clatter::numeric {

/// Sizes that a contact is expected to have, right to a factor of two or so; they scale tolerances and first steps.
struct ContactScales {
  double depth = 0;   ///< [m]
  double speed = 0;   ///< [m/s]
  double time = 0;    ///< of the contact [s]
  double energy = 0;  ///< [J]
};

/// From the depth to which the body, pushed straight down at its touch-down attitude, takes up the energy that its
/// touching point `point` (body frame) brings:
///     (1 + c_G v/k_G) U(depth) = ½ m_eff v² + m g depth.
/// `system` has begun with `touch`.  Not finite if there is no such depth.
[[nodiscard]] ContactScales contact_scales(ContactSystem& system, const MotionState& touch, const Vector3& point);

}  // namespace clatter::numeric
