// SPDX-License-Identifier: GPL-3.0-or-later
// Names of what friction did during a contact.
#pragma once

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

}  // namespace clatter::numeric
