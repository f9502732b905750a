// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a body and its motion are their own mirror image.
#pragma once

#include "numeric/body.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::validation {

/// Whether the body at this attitude is its own mirror image in the vertical plane y = 0 through its centre of mass and
/// moves along it, so that the motion stays in it.  Vertices and products of inertia count as mirrored within 1e-9 of
/// the body's size, velocities within rounding.
[[nodiscard]] bool is_mirror_image(const numeric::Body& body, const numeric::MotionState& state);

}  // namespace clatter::validation
