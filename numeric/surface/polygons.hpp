// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons that share edges, as half-edges.
#pragma once

#include <vector>

#include "numeric/surface/surface.hpp"

namespace clatter::numeric {

/// Polygon p has the corners begin[p] … begin[p + 1] − 1.  A corner also stands for the edge from
/// it to the next corner of its polygon.
struct Polygons {
  std::vector<Vector3> nodes;  ///< [m]
  std::vector<int> corners;    ///< indices into nodes
  std::vector<int> begin{0};
  std::vector<int> owner;     ///< polygon of each corner
  std::vector<Vector3> area;  ///< outward, of each polygon [m²]

  [[nodiscard]] int count() const { return static_cast<int>(area.size()); }
  [[nodiscard]] const Vector3& position(int corner) const { return nodes[corners[corner]]; }
  [[nodiscard]] int next(int corner) const {
    const auto p = static_cast<std::size_t>(owner[corner]);
    return corner + 1 < begin[p + 1] ? corner + 1 : begin[p];
  }
};

/// The surface's elements, warped quadrilaterals cut into four triangles (facets.hpp).
[[nodiscard]] Polygons planar_polygons(const Surface& surface);

/// For each corner the one whose edge is the same in the other direction; -1 where there is none,
/// or no single one.
[[nodiscard]] std::vector<int> opposite_corners(const Polygons& polygons);

}  // namespace clatter::numeric
