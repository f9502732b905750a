// SPDX-License-Identifier: GPL-3.0-or-later
// The surface as planar polygons, ready for contact: coplanar neighbours merged, so that a finely meshed flat
// face costs what its outline costs.
#pragma once

#include <vector>

#include "numeric/surface/surface.hpp"

namespace clatter::numeric {

/// A closed polygon of a facet: corners[begin] … corners[end − 1].  Outer loops run counter-clockwise seen from
/// outside the body, holes clockwise, so that signed areas add up.
struct Loop {
  int begin = 0;
  int end = 0;
};

/// A planar piece of the surface: loops[begin] … loops[end − 1].
struct Facet {
  Vector3 normal = Vector3::UnitZ();  ///< outward unit normal
  int begin = 0;
  int end = 0;
};

struct Facets {
  std::vector<Vector3> vertices;  ///< [m]
  std::vector<int> corners;       ///< indices into vertices
  std::vector<Loop> loops;
  std::vector<Facet> facets;

  /// Calls visit(index into vertices) for each corner of a facet.
  void for_each_corner(int facet, auto&& visit) const {
    const Facet& which = this->facets[static_cast<std::size_t>(facet)];
    for (int l = which.begin; l < which.end; ++l) {
      const Loop& loop = loops[static_cast<std::size_t>(l)];
      for (int c = loop.begin; c < loop.end; ++c) visit(corners[static_cast<std::size_t>(c)]);
    }
  }
};

/// Planar polygons with the same points and area as `surface`.  A quadrilateral that is warped (a corner off
/// the plane of its diagonals' cross product by more than 1e-12 of its size) becomes four triangles around the
/// mean of its corners, which does not depend on the numbering.  With `merge`, elements that share an edge and
/// a plane (normals and offsets equal to within 1e-12 of 1 and of the surface's size, compared with the first
/// element of the group so that curvature cannot creep) become one facet, and corners on a straight line that
/// only two facets share are dropped.  Vertices that no corner uses are dropped.
[[nodiscard]] Facets planar_facets(const Surface& surface, bool merge = true);

}  // namespace clatter::numeric
