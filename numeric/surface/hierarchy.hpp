// SPDX-License-Identifier: GPL-3.0-or-later
// A bounding-volume hierarchy over the facets, so that only those near the ground are visited.
#pragma once

#include <cassert>
#include <vector>

#include "numeric/surface/facets.hpp"

namespace clatter::numeric {

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
      const Node& node = nodes_[static_cast<std::size_t>(index)];
      if (!wanted(node)) continue;
      if (node.right < 0) {
        for (int i = node.begin; i < node.end; ++i) visit(order_[static_cast<std::size_t>(i)]);
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
