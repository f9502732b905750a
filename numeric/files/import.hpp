// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes and surfaces from files.
#pragma once

#include <string>
#include <string_view>

#include "numeric/files/file_names.hpp"
#include "numeric/mesh/mesh.hpp"
#include "numeric/surface/repair.hpp"
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

/// Whether this build can read glTF, 3MF and COLLADA (assimp's headers were there when it was made).
[[nodiscard]] bool has_assimp() noexcept;

struct SurfaceFileOptions {
  double unit = 0;      ///< of the coordinates [m]; 0: that which the file or its form names, else 1
  double weld = 1e-6;   ///< RepairOptions::weld
  bool strict = false;  ///< RepairOptions::strict; bytes behind the last triangle are refused, too
};

struct SurfaceFile {
  Surface surface;  ///< [m]
  Repairs repairs;
  double unit = 1;  ///< of the file's coordinates [m]
};

/// The closed surface of the triangles in a file, repaired (repair.hpp).  Corners at equal coordinates are one node.
/// STL, OBJ, PLY and OFF are read here, with all digits that they have; of others assimp hands over 32 bits.
/// @throws MeshError naming the file, and the line or triangle: unreadable, truncated, no file on a disk, none of these
///         forms; a face with a corner that is not there; whatever cannot be repaired.  std::domain_error for the unit.
[[nodiscard]] SurfaceFile read_surface(const std::string& path, const SurfaceFileOptions& options = {});

/// The same of the contents of such a file, whose name is as before; not of the forms that assimp reads.
[[nodiscard]] SurfaceFile parse_surface(const std::string& path, std::string_view contents,
                                        const SurfaceFileOptions& options = {});

/// The same of an STL file, whatever its name, with nothing repaired.
[[nodiscard]] Surface read_stl(const std::string& path, double unit = 1);

}  // namespace clatter::numeric
