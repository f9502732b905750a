// SPDX-License-Identifier: GPL-3.0-or-later
// Where a body lies at rest on the ground.
#pragma once

#include "numeric/body/body.hpp"
#include "numeric/drop/settings.hpp"
#include "numeric/motion/ground_motion.hpp"

namespace clatter::numeric {

/// The equilibrium on the ground that a body comes to from the attitude of `near`, as equilibrium_near has it: depth
/// and tilt where the springs, pad or half-space carry its weight.  A level face of area A lies m g/(k_G A) deep.  A
/// drop with Request::starts_on_ground that begins there lies still.  The place of `near` along the ground is kept.
/// @throws std::domain_error if the world is not valid, NumericalError if there is no such equilibrium: without
/// gravity, or on a slope that friction cannot hold the body on.
[[nodiscard]] Equilibrium equilibrium(const Body& body, const World& world, const MotionState& near);

/// The same of a body that slides along the ground with `near`'s velocity and does not spin: friction, μ_k of the
/// weight against the slide, presses its front deeper, so that it slides on without rocking.  Where friction tips it
/// over, or the law is `regularised`, equilibrium's.
[[nodiscard]] Equilibrium sliding_equilibrium(const Body& body, const World& world, const MotionState& near);

}  // namespace clatter::numeric
