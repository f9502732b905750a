// SPDX-License-Identifier: GPL-3.0-or-later
// Which of several closed surfaces lies in which: solids, cavities, solids within a solid.
#pragma once

#include <array>
#include <vector>

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

/// Triangles of closed pieces, each facing one way throughout.
struct PiecedTriangles {
  const std::vector<Vector3>& nodes;
  const std::vector<std::array<int, 3>>& triangles;
  const std::vector<int>& piece;  ///< of each triangle, in 0 … count − 1
  int count = 0;
};

/// What to do with each piece.
struct Pieces {
  std::vector<char> turns, keeps;  ///< by piece
  int parts = 0, cavities = 0, nested = 0, overlapping = 0;
  int flat_triangles = 0;    ///< of pieces that enclose nothing, which are not kept
  double shared_volume = 0;  ///< bound on what overlapping pieces have in common [m³]
};

/// A piece within no other faces outward.  One within another is its cavity, or a solid in its cavity, if it faces the
/// other way in the file; else it is left out, since its volume is the other's already.  That pieces cross is found
/// from edges that pierce triangles and from triangles that lie within the other piece.
[[nodiscard]] Pieces sorted_pieces(const PiecedTriangles& all);

}  // namespace clatter::numeric
