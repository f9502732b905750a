// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a drop at a time that was asked for.
#pragma once

#include <limits>

#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// Estimates of a state's errors, as large as they may well be; NaN: not known.
struct StateErrors {
  double position = std::numeric_limits<double>::quiet_NaN();          ///< distance of the centre of mass [m]
  double angle = std::numeric_limits<double>::quiet_NaN();             ///< by which the attitude is turned [rad]
  double velocity = std::numeric_limits<double>::quiet_NaN();          ///< size of the difference [m/s]
  double angular_velocity = std::numeric_limits<double>::quiet_NaN();  ///< size of the difference, body frame [rad/s]
  double energy = std::numeric_limits<double>::quiet_NaN();            ///< of StateRecord::energy [J]
};

/// One instant.  An instant exactly at a touch-down is one of the contact, exactly at a lift-off one of the flight.
struct StateRecord {
  double time = 0;  ///< after the first touch-down; of a drop without one, after its start [s]
  /// Whether the run tells the state.  If not, every number below but `impacts` is NaN.
  bool known = false;
  MotionState state;
  int impacts = 0;  ///< begun so far
  bool in_contact = false;
  Vector3 force = Vector3::Zero();  ///< of contact, world [N]
  double energy = 0;                ///< translational + rotational + potential (m g z) [J]
  double energy_stored = 0;         ///< in the ground's springs [J]
  /// Growth of a relative error of the start until now, or until the end of the contact; NaN if not asked for.
  double amplification = std::numeric_limits<double>::quiet_NaN();
  StateErrors error;
};

}  // namespace clatter::numeric
