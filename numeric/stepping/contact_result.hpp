// SPDX-License-Identifier: GPL-3.0-or-later
// What a contact is expected to be, and what it has come to.
#pragma once

#include <optional>

#include "numeric/body/body.hpp"
#include "numeric/motion/ground_motion.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// How friction acted during an impact: its phases in their order.
enum class FrictionMode {
  frictionless,
  slip,  ///< from beginning to end, in one direction
  stick,
  slip_stick,
  stick_slip,       ///< stick gives way
  slip_stick_slip,  ///< slip stops, sticks and is let go again
  stick_slip_stick,
  alternating,   ///< more phases than three
  reverse_slip,  ///< slip stops and goes on the other way at once
  regularised,
  local,  ///< each place slips for itself
};

/// Sizes that a contact is expected to have, right to a factor of two or so; they scale tolerances and first steps.
struct ContactScales {
  double depth = 0;   ///< [m]
  double speed = 0;   ///< [m/s]
  double time = 0;    ///< of the contact [s]
  double energy = 0;  ///< [J]
};

/// Why a contact's run ended.
enum class ContactEnding {
  lift_off,
  at_rest,
  sustained_contact,  ///< steady sliding or spinning that nothing stops
  evaluation_limit,
  step_too_small,
  not_representable,
  interrupted
};

struct ContactResult {
  ContactEnding ending = ContactEnding::lift_off;
  double duration = 0;  ///< [s]
  MotionState after;    ///< at the end
  /// On the ground, from `goes_on_from` on: what it takes to come to rest is part of the contact.
  std::optional<GroundMotion> goes_on;
  double goes_on_from = 0;                                        ///< after touch-down [s]
  double work_damping = 0, work_released = 0, work_friction = 0;  ///< [J]
  double energy_stored = 0;                                       ///< in the ground's springs at the end [J]
  double peak_force = 0;                                          ///< largest F_n [N]
  double peak_time = 0;                                           ///< after touch-down [s]
  double indentation = 0;                                         ///< largest depth of a point below the ground [m]
  FrictionMode mode = FrictionMode::frictionless;
  int touches = 0;
  bool submerged = false;  ///< see ImpactRecord
  ContactEnd end = ContactEnd::middle;
  ContactScales scales;
  /// Change of the tangential impulse that FrictionLaw::local would make of a contact with FrictionLaw::coulomb,
  /// estimated (LocalSlipEstimate) if asked for [N·s].
  double local_slip = 0;
  double left_out = 0;  ///< see FrictionPhases::left_out [m/s]
  double step = 0;      ///< fixed step used [s]; 0: adaptive
};

}  // namespace clatter::numeric
