// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for read_assimp.cpp where assimp's headers were not found.
#include "numeric/base/errors.hpp"
#include "numeric/files/import.hpp"
#include "numeric/files/triangle_files.hpp"

namespace clatter::numeric {

bool has_assimp() noexcept { return false; }

TriangleFile read_by_assimp(const std::string& path) {
  throw MeshError(path + ": this build reads no glTF, 3MF and COLLADA (Debian package libassimp-dev)");
}

}  // namespace clatter::numeric
