// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes and surfaces from files.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "numeric/mesh/mesh.hpp"
#include "numeric/surface/repair.hpp"
#include "numeric/surface/surface.hpp"

namespace clatter::numeric {

// Which files hold meshes, by the ends of their names.

/// Files of triangles; the last four are read by assimp's library.
inline constexpr std::array<std::string_view, 8> surface_extensions{".stl",  ".obj", ".ply", ".off",
                                                                    ".gltf", ".glb", ".3mf", ".dae"};
/// What Gmsh reads: solid elements, or a geometry that it meshes.
inline constexpr std::array<std::string_view, 4> gmsh_extensions{".msh", ".geo", ".step", ".stp"};

/// Index of the extension, of whatever case, with which the path ends; their number if there is none.
[[nodiscard]] std::size_t extension_index(const auto& extensions, std::string_view path) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  const auto ends_path = [&](std::string_view extension) {
    return path.size() > extension.size() &&
           std::equal(extension.begin(), extension.end(), path.end() - static_cast<std::ptrdiff_t>(extension.size()),
                      [&](char a, char b) { return a == small(b); });
  };
  return static_cast<std::size_t>(std::find_if(extensions.begin(), extensions.end(), ends_path) - extensions.begin());
}

[[nodiscard]] inline bool is_surface_file(std::string_view path) {
  return extension_index(surface_extensions, path) < surface_extensions.size();
}
[[nodiscard]] inline bool is_gmsh_file(std::string_view path) {
  return extension_index(gmsh_extensions, path) < gmsh_extensions.size();
}

/// Whether it is a geometry with a unit of its own.
[[nodiscard]] inline bool is_cad_file(std::string_view path) {
  const std::size_t first = 2;  // of gmsh_extensions
  return is_gmsh_file(path) && extension_index(gmsh_extensions, path) >= first;
}

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
