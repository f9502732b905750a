// SPDX-License-Identifier: GPL-3.0-or-later
// The closed surface of a body, made of triangles and quadrilaterals.
#pragma once

#include <array>
#include <vector>

#include "numeric/mesh/mesh.hpp"

namespace clatter::numeric {

/// Corners counter-clockwise seen from outside; nodes[3] = -1 for a triangle.
struct SurfaceElement {
  std::array<int, 4> nodes{-1, -1, -1, -1};
  int element = -1;  ///< the solid element that it bounds, or the index of the triangle in an STL file
};

struct Surface {
  std::vector<Vector3> nodes;  ///< [m]; all of them belong to some element
  std::vector<SurfaceElement> elements;
};

/// The faces that belong to exactly one solid element, oriented outward.
/// @throws MeshError naming the element: a node number out of range or repeated; a coordinate that is not finite;
/// an inverted or degenerate element; a face shared by more than two elements, or by two with the same
/// orientation; an edge of the boundary that is not shared by exactly two boundary faces (non-manifold);
/// no element at all.
[[nodiscard]] Surface boundary_surface(const Mesh& mesh);

/// Refuses a surface that is open, non-manifold, inconsistently or inwardly oriented (enclosed volume not
/// positive), or has an element without area.
/// @throws MeshError naming the element.
void check_closed(const Surface& surface);

}  // namespace clatter::numeric
