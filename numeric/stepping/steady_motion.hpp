// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a contact has become a motion that goes on as it is.
#pragma once

#include <optional>

#include "numeric/contact/contact_system.hpp"
#include "numeric/motion/ground_motion.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

/// The motion of a body that lies still, or in a motion so steady that friction will never stop it; nothing where the
/// contact goes on.  A motion is steady if only sliding along the ground and spinning about the vertical are left,
/// neither with an acceleration but a slope's: to a millionth of what a fall into this contact would have, or to
/// `kept_up` [m/s], the speed that the errors of steps keep up.
[[nodiscard]] std::optional<GroundMotion> motion_on_the_ground(const ContactSystem& system, const ContactInstant& at,
                                                               double kept_up);

}  // namespace clatter::numeric
