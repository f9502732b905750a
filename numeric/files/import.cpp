// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "numeric/base/errors.hpp"
#include "numeric/files/file_text.hpp"
#include "numeric/files/import.hpp"
#include "numeric/files/triangle_files.hpp"

namespace clatter::numeric {
namespace {

using Parse = TriangleFile (*)(std::string_view file);

/// Readers of surface_extensions; those without one are assimp's.
constexpr std::array<Parse, surface_extensions.size()> readers{parse_stl, parse_obj, parse_ply, parse_off};

/// Null: assimp's.
Parse reader_of(const std::string& path) {
  const std::size_t form = extension_index(surface_extensions, path);
  if (form == surface_extensions.size())
    throw MeshError(path + ": is no .stl, .obj, .ply, .off, .gltf, .glb, .3mf or .dae file");
  return readers[form];
}

TriangleFile parsed(const std::string& path, std::string_view contents, Parse parse) {
  try {
    return parse(contents);
  } catch (const MeshError& error) {
    throw MeshError(path + error.what());
  }
}

SurfaceFile made(const std::string& path, TriangleFile file, const SurfaceFileOptions& options) {
  SurfaceFile done{.surface = {},
                   .repairs = {},
                   .unit = options.unit > 0 ? options.unit
                           : file.unit > 0  ? file.unit
                                            : 1};
  try {
    if (options.strict && file.trailing > 0)
      throw MeshError("trailing data: " + std::to_string(file.trailing) + " bytes behind the last triangle");
    for (Vector3& corner : file.triangles.corners) corner *= done.unit;
    RepairedSurface repair = repaired(std::move(file.triangles), {.weld = options.weld, .strict = options.strict});
    done.surface = std::move(repair.surface);
    done.repairs = repair.repairs;
  } catch (const MeshError& error) {
    throw MeshError(path + ": " + error.what());
  }
  return done;
}

}  // namespace

SurfaceFile read_surface(const std::string& path, const SurfaceFileOptions& options) {
  if (options.unit != 0) detail::require_positive("unit", options.unit);
  return reader_of(path) ? parse_surface(path, file_contents(path), options)
                         : made(path, read_by_assimp(path), options);
}

SurfaceFile parse_surface(const std::string& path, std::string_view contents, const SurfaceFileOptions& options) {
  if (options.unit != 0) detail::require_positive("unit", options.unit);
  const Parse reader = reader_of(path);
  if (!reader) throw MeshError(path + ": can only be read from a disk");
  return made(path, parsed(path, contents, reader), options);
}

Surface read_stl(const std::string& path, double unit) {
  detail::require_positive("unit", unit);
  return made(path, parsed(path, file_contents(path), parse_stl), {.unit = unit, .strict = true}).surface;
}

}  // namespace clatter::numeric
