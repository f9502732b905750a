// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of triangles, one for each form of file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "numeric/surface/repair.hpp"

namespace clatter::numeric {

/// What a file has, in its own unit.
struct TriangleFile {
  Triangles triangles;
  double unit = 0;           ///< that the file or its form names [m]; 0: none
  std::size_t trailing = 0;  ///< bytes behind the last triangle that belong to nothing
};

// Each takes the file's contents.  Their messages begin with ":LINE: " in a text, with ": " else.
[[nodiscard]] TriangleFile parse_stl(std::string_view file);
/// Wavefront OBJ: its v and f lines.
[[nodiscard]] TriangleFile parse_obj(std::string_view file);
/// Text or binary of either byte order: x, y, z of its vertices and the lists of its faces.
[[nodiscard]] TriangleFile parse_ply(std::string_view file);
/// Object file format, as text.
[[nodiscard]] TriangleFile parse_off(std::string_view file);
/// glTF, 3MF and COLLADA, read by assimp's library; each instance of a mesh in its place.
[[nodiscard]] TriangleFile read_by_assimp(const std::string& path);

/// Cuts a plane polygon, which need not be convex, into triangles with its corners.
/// @pre the corners are there
void add_polygon(Triangles& triangles, const std::vector<int>& polygon);

}  // namespace clatter::numeric
