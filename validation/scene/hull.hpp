// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a point lies within the convex hull of others.
#pragma once

#include <vector>

#include "numeric/base/linear_algebra.hpp"

namespace clatter::validation::inline scene {

/// Whether a plane separates `point` from all of `points` by more than 1e-9 of the largest distance between them and
/// it.  The answer true is certified by that plane; a point on the hull's surface lies within it.
[[nodiscard]] bool is_outside_hull(const numeric::Vector3& point, const std::vector<numeric::Vector3>& points);

}  // namespace clatter::validation::inline scene
