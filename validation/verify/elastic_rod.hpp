// SPDX-License-Identifier: GPL-3.0-or-later
// Contact angles of the elastic rod, of which many claims and errata speak.
#pragma once

#include "analytic/plane/contact_angles.hpp"

namespace clatter::validation::inline verify {

/// For θ in degrees; G = g L/v_n².
[[nodiscard]] inline analytic::ContactAngles elastic_angles(double degrees, double gravity_number = 0) {
  return contact_angles(analytic::Angle::from_degrees(degrees), {.gravity_number = gravity_number});
}

}  // namespace clatter::validation::inline verify
