// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid body as a finite-element mesh of straight-sided solids.
#pragma once

#include <array>
#include <vector>

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

enum class ElementShape { tetrahedron, prism, hexahedron };

/// One solid element.  Nodes are numbered as in the finite-element literature (and Gmsh): tetrahedron 0 1 2 3
/// with (x1−x0)×(x2−x0)·(x3−x0) > 0; prism bottom 0 1 2, top 3 4 5; hexahedron bottom 0 1 2 3, top 4 5 6 7,
/// each bottom counter-clockwise seen from the top, node i + n/2 above node i.  Unused entries are -1.
struct Element {
  ElementShape shape = ElementShape::tetrahedron;
  std::array<int, 8> nodes{-1, -1, -1, -1, -1, -1, -1, -1};
  double density = 1;  ///< [kg/m³], > 0
};

struct Mesh {
  std::vector<Vector3> nodes;  ///< [m], any frame
  std::vector<Element> elements;
};

}  // namespace clatter::numeric
