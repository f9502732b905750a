// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds on the errors of a sequence's numbers.
#pragma once

#include "analytic/impact_law.hpp"

namespace clatter::analytic {

/// Bounds on the errors of an impact's numbers, each in the unit of its number; infinite in a row
/// that cannot be predicted. They hold what errors of the start (one unit in the last place of each
/// number given) and rounding have grown to.
struct RowErrors {
  bool predictable = false;   ///< errors have not grown so far that another sequence may follow
  double relative = 0;        ///< largest of start, contact angle and normal impulse, beside the number itself
  double start = 0;           ///< [s]
  double inclination = 0;     ///< [rad]
  double contact_angle = 0;   ///< [rad]
  double approach_speed = 0;  ///< [m/s]
  double restitution = 0;
  double normal_impulse = 0;      ///< [N·s]
  double tangential_impulse = 0;  ///< [N·s]
  double impulse_ratio = 0;
  PlanarVelocity after;
  double energy_before = 0;  ///< [J]
  double energy_after = 0;   ///< [J]
  double energy_loss = 0;    ///< [J]

  /// Nothing is known.
  [[nodiscard]] static RowErrors unknown();
};

}  // namespace clatter::analytic
