// SPDX-License-Identifier: GPL-3.0-or-later
// What a contact has come to.
#pragma once

#include "numeric/body/contact_end.hpp"
#include "numeric/motion/motion_state.hpp"
#include "numeric/stepping/contact_scales.hpp"
#include "numeric/stepping/friction_mode.hpp"

namespace clatter::numeric {

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
  double duration = 0;                                            ///< [s]
  MotionState after;                                              ///< at the end
  double work_damping = 0, work_released = 0, work_friction = 0;  ///< [J]
  double energy_stored = 0;                                       ///< in the ground's springs at the end [J]
  double peak_force = 0;                                          ///< largest F_n [N]
  double peak_time = 0;                                           ///< after touch-down [s]
  FrictionMode mode = FrictionMode::frictionless;
  int touches = 0;
  bool submerged = false;  ///< see ImpactRecord
  ContactEnd end = ContactEnd::middle;
  ContactScales scales;
  /// Change of the tangential impulse that FrictionLaw::local would make of a contact with FrictionLaw::coulomb,
  /// estimated (LocalSlipEstimate) if asked for [N·s].
  double local_slip = 0;
  double step = 0;  ///< fixed step used [s]; 0: adaptive
};

}  // namespace clatter::numeric
