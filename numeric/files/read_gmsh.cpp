// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef CLATTER_GMSH_LIBRARY
#include <dlfcn.h>
#include <gmshc.h>
#endif

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>

#include "numeric/base/errors.hpp"
#include "numeric/files/file_text.hpp"
#include "numeric/files/import.hpp"
#include "numeric/mesh/element_geometry.hpp"

namespace clatter::numeric {
#ifdef CLATTER_GMSH_LIBRARY
namespace {

using Tag = std::size_t;

/// Gmsh's library.  It is loaded when a file asks for it: with the hundred that it needs it takes longer than most
/// runs.
class Library {
 public:
  /// The function is called by its name in gmshc.h, whose declaration gives its type, and must report no error.
  template <class Function, class... Arguments>
  static void call(const char* name, Arguments... arguments) {
    int error = 0;
    reinterpret_cast<Function*>(symbol(name))(arguments..., &error);
    if (error) throw MeshError("Gmsh says: " + last_error());
  }

  static void free(void* memory) { reinterpret_cast<decltype(gmshFree)*>(symbol("gmshFree"))(memory); }

 private:
  static void* symbol(const char* name) {
    // It stays loaded: some of its libraries cannot be loaded twice.
    static void* const library = dlopen(CLATTER_GMSH_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    void* const found = library ? dlsym(library, name) : nullptr;
    if (!found) throw MeshError("Gmsh's library cannot be loaded: " + std::string(dlerror()));
    return found;
  }

  static std::string last_error() {
    char* text = nullptr;
    int error = 0;
    reinterpret_cast<decltype(gmshLoggerGetLastError)*>(symbol("gmshLoggerGetLastError"))(&text, &error);
    const std::string copy = text && *text ? text : "no more than that it failed";
    free(text);
    return copy;
  }
};

/// An array that Gmsh hands over.
template <class Value>
class Array {
 public:
  Array() = default;
  Array(const Array&) = delete;
  Array& operator=(const Array&) = delete;
  ~Array() { Library::free(first_); }
  [[nodiscard]] Value** first() { return &first_; }
  [[nodiscard]] std::size_t* count() { return &count_; }
  [[nodiscard]] std::span<const Value> values() const { return {first_, count_}; }
  [[nodiscard]] Value operator[](std::size_t i) const { return first_[i]; }

 private:
  Value* first_ = nullptr;
  std::size_t count_ = 0;
};

/// Arrays of one sort of element each.
class Arrays {
 public:
  Arrays() = default;
  Arrays(const Arrays&) = delete;
  Arrays& operator=(const Arrays&) = delete;
  ~Arrays() {
    for (std::size_t i = 0; i < number; ++i) Library::free(first[i]);
    Library::free(first);
    Library::free(counts);
  }
  [[nodiscard]] std::span<const Tag> operator[](std::size_t i) const { return {first[i], counts[i]}; }

  Tag** first = nullptr;
  std::size_t* counts = nullptr;
  std::size_t number = 0;
};

/// Gmsh without a word on the terminal and without the user's configuration files.
class Session {
 public:
  Session() {
    Library::call<decltype(gmshInitialize)>("gmshInitialize", 0, nullptr, 0);
    Library::call<decltype(gmshOptionSetNumber)>("gmshOptionSetNumber", "General.Terminal", 0.0);
  }
  ~Session() { Library::call<decltype(gmshFinalize)>("gmshFinalize"); }
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

std::string group_name(int group) {
  Array<char> name;
  Library::call<decltype(gmshModelGetPhysicalName)>("gmshModelGetPhysicalName", 3, group, name.first());
  return *name.first();
}

double volume_density(int volume, double otherwise) {
  Array<int> groups;
  Library::call<decltype(gmshModelGetPhysicalGroupsForEntity)>("gmshModelGetPhysicalGroupsForEntity", 3, volume,
                                                               groups.first(), groups.count());
  std::optional<double> found;
  for (const int group : groups.values()) {
    const std::optional<double> density = density_in(group_name(group));
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
  Array<char> name;
  Array<double> parametric;
  int dimension = 0, order = 0, nodes = 0, primary = 0;
  Library::call<decltype(gmshModelMeshGetElementProperties)>("gmshModelMeshGetElementProperties", type, name.first(),
                                                             &dimension, &order, &nodes, parametric.first(),
                                                             parametric.count(), &primary);
  throw MeshError("the element with tag " + std::to_string(first_tag) + " is of type \"" + *name.first() +
                  "\"; only first-order tetrahedra, prisms and hexahedra can be read");
}

void add_volume(int volume, double density, std::vector<TaggedElement>& elements) {
  Array<int> types;
  Arrays tags, nodes;
  Library::call<decltype(gmshModelMeshGetElements)>("gmshModelMeshGetElements", types.first(), types.count(),
                                                    &tags.first, &tags.counts, &tags.number, &nodes.first,
                                                    &nodes.counts, &nodes.number, 3, volume);
  for (std::size_t t = 0; t < types.values().size(); ++t) {
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
  Array<int> entities;  // dimension, tag, dimension, tag, ...
  Library::call<decltype(gmshModelGetEntities)>("gmshModelGetEntities", entities.first(), entities.count(), 3);
  std::vector<TaggedElement> elements;
  for (std::size_t i = 1; i < entities.values().size(); i += 2) {
    add_volume(entities[i], volume_density(entities[i], density), elements);
  }
  if (elements.empty()) throw MeshError("has no solid element");
  std::sort(elements.begin(), elements.end(),
            [](const TaggedElement& a, const TaggedElement& b) { return a.tag < b.tag; });
  return elements;
}

/// Positions of all nodes by their tags.
std::unordered_map<Tag, Vector3> tagged_nodes(double unit) {
  Array<Tag> tags;
  Array<double> coordinates, parametric;
  Library::call<decltype(gmshModelMeshGetNodes)>("gmshModelMeshGetNodes", tags.first(), tags.count(),
                                                 coordinates.first(), coordinates.count(), parametric.first(),
                                                 parametric.count(), -1, -1, 0, 0);
  std::unordered_map<Tag, Vector3> nodes(tags.values().size());
  for (std::size_t i = 0; i < tags.values().size(); ++i) {
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
  if (!is_gmsh_file(path)) throw MeshError("is neither a .msh nor a .geo, .step or .stp file");
  const bool geometry = extension_index(gmsh_extensions, path) > 0;
  static_cast<void>(file_contents(path));  // refuses what is no file on a disk
  const Session session;
  Library::call<decltype(gmshOpen)>("gmshOpen", path.c_str());
  if (geometry) Library::call<decltype(gmshModelMeshGenerate)>("gmshModelMeshGenerate", 3);
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
  }
}

#else  // the library was not found, or not wanted

bool has_gmsh() noexcept { return false; }

Mesh read_gmsh(const std::string& path, double /*density*/, double /*unit*/) {
  throw MeshError(path + ": this build has no Gmsh (Debian package libgmsh-dev)");
}

#endif
}  // namespace clatter::numeric
