// SPDX-License-Identifier: GPL-3.0-or-later
// The surface as planar polygons, ready for contact: coplanar neighbours merged, so that a finely meshed flat
// face costs what its outline costs.
#pragma once

#include <cassert>
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
    const Facet& which = this->facets[facet];
    for (int l = which.begin; l < which.end; ++l) {
      const Loop& loop = loops[l];
      for (int c = loop.begin; c < loop.end; ++c) visit(corners[c]);
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

// A bounding-volume hierarchy over the facets, so that only those near the ground are visited.

/// The half-space below the ground in body coordinates: height(u) = normal·u + offset < 0.
struct GroundPlane {
  Vector3 normal = Vector3::UnitZ();  ///< the ground's upward normal, unit
  double offset = 0;                  ///< height of the centre of mass [m]
  [[nodiscard]] double height(const Vector3& point) const { return normal.dot(point) + offset; }
};

/// Balanced binary tree of boxes aligned with the body's axes.
class Hierarchy {
 public:
  Hierarchy() = default;
  explicit Hierarchy(const Facets& facets);

  /// Calls visit(facet index) for each facet whose box reaches below height `margin`.
  /// Cost: log(facets) + facets visited.  No allocation.
  void visit_below(const GroundPlane& plane, double margin, auto&& visit) const {
    search([&](const Node& node) { return lowest(node, plane) < margin; }, visit);
  }

  /// Visits every facet in a box that `wanted(centre, half extents)` accepts, nearer children first or not: no order.
  void visit_if(auto&& wanted, auto&& visit) const {
    search([&](const Node& node) { return wanted(node.centre, node.half); }, visit);
  }

 private:
  struct Node {
    Vector3 centre, half;
    int begin = 0, end = 0;  ///< of order_
    int right = -1;          ///< child; the left one follows its parent; -1 in a leaf
  };

  int build(const std::vector<Node>& boxes, int begin, int end);
  static double lowest(const Node& node, const GroundPlane& plane) {
    return plane.height(node.centre) - plane.normal.cwiseAbs().dot(node.half);
  }

  void search(auto&& wanted, auto&& visit) const {
    if (nodes_.empty()) return;
    int stack[64];  // deeper than a balanced tree over all ints
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      assert(top + 1 < 64);
      const int index = stack[--top];
      const Node& node = nodes_[index];
      if (!wanted(node)) continue;
      if (node.right < 0) {
        for (int i = node.begin; i < node.end; ++i) visit(order_[i]);
      } else {
        stack[top++] = node.right;
        stack[top++] = index + 1;
      }
    }
  }

  std::vector<Node> nodes_;
  std::vector<int> order_;
};

}  // namespace clatter::numeric
