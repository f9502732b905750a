// SPDX-License-Identifier: GPL-3.0-or-later
// The convex hull of points: its corners, and whether a point lies within it.
#pragma once

#include <vector>

#include "numeric/base/linear_algebra.hpp"

namespace clatter::validation {

/// Whether a plane separates `point` from all of `points` by more than 1e-9 of the largest distance between them and
/// it.  The answer true is certified by that plane; a point on the hull's surface lies within it.
[[nodiscard]] bool is_outside_hull(const numeric::Vector3& point, const std::vector<numeric::Vector3>& points);

/// The points that their convex hull needs, each once, in the order in which they are given: those that a plane
/// separates from all other corners of the hull by more than 1e-9 of the largest distance to one of them.  Of points
/// within 1e-9 `size` [m] of each other the first counts.  Points that lie in a plane to rounding are all kept.
/// Cost: n log n, for bodies without faces of thousands of corners.
[[nodiscard]] std::vector<numeric::Vector3> hull_corners(const std::vector<numeric::Vector3>& points, double size);

/// A plane face of a hull, seen from a point within it.
struct HullFace {
  numeric::Vector3 normal = numeric::Vector3::UnitZ();  ///< outward, unit
  double distance = 0;                                  ///< of the plane from the point [m]
};

/// The faces of the convex hull of `corners` on which a body whose centre of mass is their origin can lie: the foot of
/// the centre's perpendicular is in the face, to 1e-9 of the hull's reach.  Normals within 1e-6 of each other are of
/// one face.  None for corners that lie in a plane.
[[nodiscard]] std::vector<HullFace> resting_faces(const std::vector<numeric::Vector3>& corners);

}  // namespace clatter::validation
