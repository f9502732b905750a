// SPDX-License-Identifier: GPL-3.0-or-later
// What the ends of a flight prove of a vertex between them, without a search.
#pragma once

#include "analytic/plane/first_root.hpp"

namespace clatter::analytic {

/// Whether heights, velocities and curvatures at 0 and at `end` prove that h > 0 on (0, end] and that first_root()
/// would pass no turning point there: within half a turn the curvature changes its sign once at most.  False: they do
/// not.
/// @param turn rate × end
[[nodiscard]] bool stays_above(const VertexHeight& height, double end, const detail::Turn& turn);

}  // namespace clatter::analytic
