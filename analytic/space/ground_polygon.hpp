// SPDX-License-Identifier: GPL-3.0-or-later
// The polygon that touching corners span on the ground.
#pragma once

#include <vector>

#include "analytic/space/body.hpp"

namespace clatter::analytic::space {

/// Indices of the points on the corners of the convex hull, counter-clockwise; two if all lie on one line to rounding
/// (the outermost ones), one if all coincide.
[[nodiscard]] std::vector<int> convex_hull(const std::vector<Vector2>& points);

/// Distance of `point` from the nearest side of the hull of `corners`: > 0 inside, < 0 outside [m]; −infinity where the
/// hull has no area.
[[nodiscard]] double margin_inside(const std::vector<Vector2>& corners, const Vector2& point);

}  // namespace clatter::analytic::space
