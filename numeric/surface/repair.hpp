// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a closed surface of triangles that nearly are one, as drawing programs export them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "numeric/surface/surface.hpp"

namespace clatter::numeric {

/// Triangles as a file has them, with corners that need not be shared.
struct Triangles {
  std::vector<Vector3> corners;               ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< indices of corners, counter-clockwise seen from outside
  double rounding = 0;                        ///< error of a coordinate relative to it: 2⁻²⁴ where it has 32 bits
};

struct RepairOptions {
  /// Corners at unmatched edges that are closer than this are one, and one that lies so close to an unmatched edge lies
  /// on it; of the largest extent, >= 0.
  double weld = 1e-6;
  bool strict = false;  ///< nothing is repaired but corners at equal coordinates: what repair would do is refused
};

/// What was done, and how well the volume is known.
struct Repairs {
  int joined = 0;       ///< corners moved to another or onto an edge
  int flat = 0;         ///< triangles without area, left out
  int doubled = 0;      ///< triangles that lie on another, left out
  int turned = 0;       ///< triangles that faced inward
  int touching = 0;     ///< edges shared by four triangles or more, where parts touch
  int parts = 0;        ///< pieces of the surface that bound the body from outside
  int cavities = 0;     ///< pieces that bound it from within
  int nested = 0;       ///< solids within another, left out: their volume is the other's
  int overlapping = 0;  ///< pairs of pieces whose surfaces cross: what they share counts twice
  double volume = 0;    ///< enclosed [m³]
  /// Bound to first order of what rounding of the coordinates, moved corners and overlaps leave of the volume [m³], and
  /// of its second moments about any axis through its centre [m⁵].
  double volume_error = 0, moment_error = 0;

  [[nodiscard]] bool any() const { return joined + flat + doubled + turned + touching + nested + overlapping > 0; }
  /// "3 corners joined, 2 flat triangles left out"; "nothing repaired".
  [[nodiscard]] std::string words() const;
};

struct RepairedSurface {
  Surface surface;  ///< closed (check_closed); each element has the index of its triangle
  Repairs repairs;
};

/// Joins corners, leaves out triangles without area and doubled ones, takes edges apart at which parts touch, turns
/// closed pieces outward, cavities inward, and leaves out a solid that lies within another.  A piece within another is
/// a cavity if it faces the other way in the file.  A surface with nothing to repair keeps its corners to the bit.
/// @throws MeshError naming a triangle: a coordinate that is not finite, a corner that is not there; an edge that stays
///         open or non-manifold, with its place; a surface with one side only; whatever `strict` refuses.
[[nodiscard]] RepairedSurface repaired(Triangles triangles, const RepairOptions& options = {});

}  // namespace clatter::numeric
