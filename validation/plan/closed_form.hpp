// SPDX-License-Identifier: GPL-3.0-or-later
// The first three impacts of a thin rod from Eqs. 9 and 12 alone.
#pragma once

#include <string>

#include "analytic/plane/sequence.hpp"

namespace clatter::validation {

/// Why the closed form does not apply to a drop; empty: it does.  It is for a thin rod that falls straight, one end
/// first, with Newton's restitution and an impulse ratio as given, or none.
[[nodiscard]] std::string reason_against_closed_form(const analytic::Drop& drop);

/// The first impacts, at most three, of a drop to which it applies.  One impact is Eq. 9; with the second and third
/// come the roots β and γ of Eq. 12.  What comes after the third impact is not known.  Accuracy: as contact_angles();
/// the rows' errors are left unknown.
[[nodiscard]] analytic::Sequence closed_form_sequence(const analytic::Drop& drop, int impacts);

}  // namespace clatter::validation
