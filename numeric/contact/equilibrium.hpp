// SPDX-License-Identifier: GPL-3.0-or-later
// Where the ground carries a body.
#pragma once

#include <optional>

#include "numeric/body/body.hpp"
#include "numeric/contact/ground.hpp"
#include "numeric/motion/ground_motion.hpp"

namespace clatter::numeric {

/// The equilibrium that a body comes to from the attitude of `near` on the way down of its energy,
///     E = m g z + U,   U the energy stored in the ground,                                                   (1)
/// by Newton's method in its height and its tilt; out of a balance that is not stable it goes on down.  It stays above
/// the place of `near` and turns about no vertical axis.  On a slope friction holds it along the ground, at the
/// pressure centre, which then lies under the centre of mass.  Accuracy: rounding of force and moment.
/// @return nothing where there is none, as on a slope that friction cannot hold it on or without gravity.
[[nodiscard]] std::optional<Equilibrium> equilibrium_near(const Body& body, const Ground& ground,
                                                          const Gravity& gravity, bool planar, const MotionState& near);

}  // namespace clatter::numeric
