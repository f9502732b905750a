// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a contact has become a motion that goes on as it is.
#pragma once

#include <optional>

#include "numeric/contact/contact_system.hpp"
#include "numeric/motion/ground_motion.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

/// The motion of a body that lies still, that slides straight on until friction stops it, or that goes on for ever;
/// nothing where the contact goes on.  Of vertical motion, tipping and accelerations other than that of the motion
/// nothing is left: to a millionth of what a fall into this contact would have, or to `kept_up` [m/s], the speed that
/// the errors of steps keep up; of a slide that friction stops to a thousandth.
/// - It rests where it neither slides nor spins, or slides at v without spin under the constant deceleration
///       a = μ_k g ∓ g_x,   for u/a over u²/(2 a),   u = v + μ_k v_z;
///   then it takes the tilt in which it is in equilibrium, and what that sets free goes to the dampers.  The
///   regularised law stops nothing in a finite time, and a slide across a slope is not straight.
/// - It slides on without friction, or down a slope that friction cannot stop it on.
/// - It spins on without friction, or about the pressure centre of a patch that counts as a point.
/// - A body whose shape and inertia are round about its axis rolls on on level ground, or turns on without friction.
///   The ground's dampers slow that in proportion to its speed.
[[nodiscard]] std::optional<GroundMotion> motion_on_the_ground(const ContactSystem& system, const ContactInstant& at,
                                                               double kept_up);

}  // namespace clatter::numeric
