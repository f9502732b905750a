// SPDX-License-Identifier: GPL-3.0-or-later
// How a contact ends without lifting off.
#pragma once

#include <optional>

#include "numeric/stepping/contact_result.hpp"
#include "numeric/stepping/contact_step.hpp"

namespace clatter::numeric {

/// Speed that the errors of steps keep up in a body that ought to lie still [m/s]: of an adaptive method with this
/// tolerance, in a contact of this speed.
[[nodiscard]] double kept_up_speed(double tolerance, double speed);

/// At rest, or in a steady motion that no friction will ever stop; nothing where the contact goes on.  A motion is
/// steady if only sliding along the ground and spinning about the vertical are left, neither with an acceleration: to a
/// millionth of what a fall into this contact would have, or to `kept_up` [m/s].
[[nodiscard]] std::optional<ContactEnding> ending_on_the_ground(const ContactSystem& system, const ContactInstant& at,
                                                                double kept_up);

}  // namespace clatter::numeric
