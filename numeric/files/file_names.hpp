// SPDX-License-Identifier: GPL-3.0-or-later
// Which files hold meshes, by the ends of their names.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace clatter::numeric {

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

}  // namespace clatter::numeric
