// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes and surfaces from files.
#pragma once

#include <string>

#include "numeric/mesh/mesh.hpp"
#include "numeric/surface/surface.hpp"

namespace clatter::numeric {

/// Whether this build can read Gmsh files (CLATTER_GMSH).
[[nodiscard]] bool has_gmsh() noexcept;

/// The solid elements of a Gmsh file (.msh, or .geo to be meshed), read by Gmsh's own library; first-order
/// tetrahedra, prisms and hexahedra.  Every element gets `density`, unless it belongs to a physical volume
/// whose name ends in "density=NUMBER".  Coordinates are multiplied by `unit` [m].
/// @throws MeshError naming the file and what is wrong: no such file, Gmsh's own complaint, pyramids or
/// higher-order elements (named by their tag), no solid element; in a build without Gmsh always, saying so.
[[nodiscard]] Mesh read_gmsh(const std::string& path, double density, double unit = 1);

/// A closed surface of triangles from an STL file, binary or text; corners at equal coordinates become one node.
/// Coordinates are multiplied by `unit` [m] (STL files are mostly in mm: 0.001).
/// @throws MeshError naming file and line or triangle: unreadable, truncated, trailing data, not finite,
/// degenerate; open, non-manifold, or inward (see check_closed).
[[nodiscard]] Surface read_stl(const std::string& path, double unit = 1);

}  // namespace clatter::numeric
