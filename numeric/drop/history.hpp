// SPDX-License-Identifier: GPL-3.0-or-later
// The time history of a simulated drop.
#pragma once

#include <functional>

#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// One instant.
struct HistorySample {
  double time = 0;  ///< after the first touch-down [s]
  MotionState state;
  Vector3 force = Vector3::Zero();           ///< of contact, world [N]
  Vector3 point_velocity = Vector3::Zero();  ///< of the body at the pressure centre, else at its lowest vertex [m/s]
  double energy_translation = 0;             ///< [J]
  double energy_rotation = 0;                ///< [J]
  double energy_potential = 0;               ///< m g z [J]
  double energy_ground = 0;                  ///< stored in the ground's springs [J]
  bool in_contact = false;

  /// Energy of body and ground together [J]; only dampers, friction and release change it.
  [[nodiscard]] double energy_total() const {
    return energy_translation + energy_rotation + energy_potential + energy_ground;
  }
};

/// Takes the samples, in the order of time: every accepted step of a contact, its ends and peak, and points of each
/// flight.
using HistoryRecorder = std::function<void(const HistorySample&)>;

}  // namespace clatter::numeric
