// Stands in for read_gmsh.cpp where Gmsh's library was not found or not wanted.
#include "numeric/errors.hpp"
#include "numeric/mesh/import.hpp"

namespace clatter::numeric {

bool has_gmsh() noexcept { return false; }

Mesh read_gmsh(const std::string& path, double /*density*/, double /*unit*/) {
  throw MeshError(path + ": this build has no Gmsh (Debian package libgmsh-dev)");
}

}  // namespace clatter::numeric
