// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for read_gmsh.cpp where Gmsh's library was not found or not wanted.
#include "numeric/base/errors.hpp"
#include "numeric/files/import.hpp"

namespace clatter::numeric {

bool has_gmsh() noexcept { return false; }

Mesh read_gmsh(const std::string& path, double /*density*/, double /*unit*/) {
  throw MeshError(path + ": this build has no Gmsh (Debian package libgmsh-dev)");
}

}  // namespace clatter::numeric
