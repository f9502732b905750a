// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmsh.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "numeric/base/errors.hpp"
#include "numeric/files/import.hpp"
#include "numeric/mesh/element_geometry.hpp"

namespace clatter::numeric::inline files {
namespace {

namespace mesh_api = gmsh::model::mesh;

using Tag = std::size_t;

/// Gmsh without a word on the terminal and without the user's configuration files.
class Session {
 public:
  Session() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
  }
  ~Session() { gmsh::finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

struct TaggedElement {
  Tag tag = 0;
  ElementShape shape = ElementShape::tetrahedron;
  std::array<Tag, 8> nodes{};
  double density = 0;
};

/// NUMBER of a name that ends in "density=NUMBER".
std::optional<double> density_in(const std::string& name) {
  constexpr std::string_view key = "density=";
  const std::size_t at = name.rfind(key);
  if (at == name.npos) return {};
  const char* end = name.data() + name.size();
  double value = 0;
  const auto [last, error] = std::from_chars(name.data() + at + key.size(), end, value);
  if (error != std::errc() || last != end || !(value > 0 && std::isfinite(value))) {
    throw MeshError("physical volume \"" + name + "\": must end in density=NUMBER, greater than 0 and finite");
  }
  return value;
}

double volume_density(int volume, double otherwise) {
  std::vector<int> groups;
  gmsh::model::getPhysicalGroupsForEntity(3, volume, groups);
  std::optional<double> found;
  for (const int group : groups) {
    std::string name;
    gmsh::model::getPhysicalName(3, group, name);
    const std::optional<double> density = density_in(name);
    if (density && found && *density != *found) {
      throw MeshError("volume " + std::to_string(volume) + ": its physical volumes give two densities");
    }
    if (density) found = density;
  }
  return found.value_or(otherwise);
}

ElementShape shape_of(int type, Tag first_tag) {
  constexpr int tetrahedron = 4, hexahedron = 5, prism = 6;  // Gmsh's numbers
  if (type == tetrahedron) return ElementShape::tetrahedron;
  if (type == hexahedron) return ElementShape::hexahedron;
  if (type == prism) return ElementShape::prism;
  std::string name;
  int dimension = 0, order = 0, nodes = 0, primary = 0;
  std::vector<double> parametric;
  mesh_api::getElementProperties(type, name, dimension, order, nodes, parametric, primary);
  throw MeshError("the element with tag " + std::to_string(first_tag) + " is of type \"" + name +
                  "\"; only first-order tetrahedra, prisms and hexahedra can be read");
}

void add_volume(int volume, double density, std::vector<TaggedElement>& elements) {
  std::vector<int> types;
  std::vector<std::vector<Tag>> tags, nodes;
  mesh_api::getElements(types, tags, nodes, 3, volume);
  for (std::size_t t = 0; t < types.size(); ++t) {
    if (tags[t].empty()) continue;
    TaggedElement element{.shape = shape_of(types[t], tags[t].front()), .density = density};
    const auto count = reference_element(element.shape).node_count;
    auto node = nodes[t].begin();
    for (const Tag tag : tags[t]) {
      element.tag = tag;
      std::copy_n(node, count, element.nodes.begin());
      node += count;
      elements.push_back(element);
    }
  }
}

/// In the order of the tags, so that the file's numbering survives.
std::vector<TaggedElement> solid_elements(double density) {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  std::vector<TaggedElement> elements;
  for (const auto& [dimension, volume] : volumes) {
    add_volume(volume, volume_density(volume, density), elements);
  }
  if (elements.empty()) throw MeshError("has no solid element");
  std::sort(elements.begin(), elements.end(),
            [](const TaggedElement& a, const TaggedElement& b) { return a.tag < b.tag; });
  return elements;
}

/// Positions of all nodes by their tags.
std::unordered_map<Tag, Vector3> tagged_nodes(double unit) {
  std::vector<Tag> tags;
  std::vector<double> coordinates, parametric;
  mesh_api::getNodes(tags, coordinates, parametric);
  std::unordered_map<Tag, Vector3> nodes(tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) {
    nodes[tags[i]] = unit * Vector3(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
  }
  return nodes;
}

/// Numbers the nodes in the order in which the elements use them.
Mesh assemble(const std::vector<TaggedElement>& elements, const std::unordered_map<Tag, Vector3>& nodes) {
  Mesh mesh;
  std::unordered_map<Tag, int> numbers;
  for (const TaggedElement& tagged : elements) {
    Element element{.shape = tagged.shape, .density = tagged.density};
    for (int i = 0; i < reference_element(tagged.shape).node_count; ++i) {
      const auto position = nodes.find(tagged.nodes[i]);
      if (position == nodes.end()) {
        throw MeshError("the element with tag " + std::to_string(tagged.tag) + " has the unknown node " +
                        std::to_string(tagged.nodes[i]));
      }
      const auto [entry, is_new] = numbers.try_emplace(tagged.nodes[i], static_cast<int>(mesh.nodes.size()));
      if (is_new) mesh.nodes.push_back(position->second);
      element.nodes[i] = entry->second;
    }
    mesh.elements.push_back(element);
  }
  return mesh;
}

Mesh read(const std::string& path, double density, double unit) {
  const bool geometry = path.ends_with(".geo");
  if (!geometry && !path.ends_with(".msh")) throw MeshError("is neither a .msh nor a .geo file");
  if (!std::ifstream(path)) throw MeshError("cannot be opened");
  const Session session;
  gmsh::open(path);
  if (geometry) mesh_api::generate(3);
  return assemble(solid_elements(density), tagged_nodes(unit));
}

}  // namespace

bool has_gmsh() noexcept { return true; }

Mesh read_gmsh(const std::string& path, double density, double unit) {
  detail::require_positive("density", density);
  detail::require_positive("unit", unit);
  try {
    return read(path, density, unit);
  } catch (const MeshError& error) {
    throw MeshError(path + ": " + error.what());
  } catch (const std::string& complaint) {  // Gmsh throws these
    throw MeshError(path + ": Gmsh says: " + complaint);
  } catch (const std::runtime_error& error) {
    throw MeshError(path + ": Gmsh says: " + error.what());
  }
}

}  // namespace clatter::numeric::inline files
