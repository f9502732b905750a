// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/surface.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>
#include <tuple>

#include "numeric/base/errors.hpp"
#include "numeric/mesh/element_geometry.hpp"
#include "numeric/surface/edges.hpp"

namespace clatter::numeric {
namespace {

int corner_count(const SurfaceElement& element) { return element.nodes[3] < 0 ? 3 : 4; }

/// One element's side of a face.  The key starts at the lowest node and goes towards its lower
/// neighbour, so that both sides of a face have the same key whatever their numbering.
struct FaceSide {
  std::array<int, 4> key;
  int element;
  std::int8_t face;
  bool reversed;
};

SurfaceElement global_face(const Mesh& mesh, int element, int face) {
  const Element& solid = mesh.elements[element];
  const Face& local = reference_element(solid.shape).faces[face];
  SurfaceElement global{.element = element};
  for (std::size_t i = 0; i < 4 && local[i] >= 0; ++i) global.nodes[i] = solid.nodes[local[i]];
  return global;
}

FaceSide face_side(const Mesh& mesh, int element, int face) {
  const SurfaceElement global = global_face(mesh, element, face);
  FaceSide side{global.nodes, element, static_cast<std::int8_t>(face), false};
  const auto end = side.key.begin() + corner_count(global);
  std::rotate(side.key.begin(), std::min_element(side.key.begin(), end), end);
  side.reversed = side.key[1] > *(end - 1);
  if (side.reversed) std::reverse(side.key.begin() + 1, end);
  return side;
}

std::vector<FaceSide> sorted_faces(const Mesh& mesh) {
  std::vector<FaceSide> sides;
  sides.reserve(6 * mesh.elements.size());
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const ElementShape shape = mesh.elements[e].shape;
    const int faces = static_cast<int>(reference_element(shape).faces.size());
    for (int f = 0; f < faces; ++f) sides.push_back(face_side(mesh, e, f));
  }
  std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
    return std::tie(a.key, a.element, a.face) < std::tie(b.key, b.element, b.face);
  });
  return sides;
}

/// The sides begin … end − 1 are those of an inner face.
void check_shared(const Mesh& mesh, std::span<const FaceSide> sides) {
  const std::string last = element_name(mesh, sides.back().element);
  const std::string first = element_name(mesh, sides.front().element);
  if (sides.size() > 2) throw MeshError(last + ": shares a face with " + first + " and another element");
  if (sides[0].reversed == sides[1].reversed) throw MeshError(last + ": lies on the same side of a face as " + first);
}

/// The faces that only one element has, in the order of the elements.
std::vector<SurfaceElement> outer_faces(const Mesh& mesh) {
  const std::vector<FaceSide> sides = sorted_faces(mesh);
  std::vector<std::pair<int, int>> outer;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].key == sides[begin].key) ++end;
    if (end - begin == 1) {
      outer.emplace_back(sides[begin].element, sides[begin].face);
    } else {
      check_shared(mesh, std::span(sides).subspan(begin, end - begin));
    }
  }
  std::sort(outer.begin(), outer.end());
  std::vector<SurfaceElement> faces;
  faces.reserve(outer.size());
  for (const auto& [element, face] : outer) faces.push_back(global_face(mesh, element, face));
  return faces;
}

Edges sorted_edges(const std::vector<SurfaceElement>& elements) {
  Edges edges;
  edges.reserve(4 * elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto count = static_cast<std::size_t>(corner_count(elements[i]));
    for (std::size_t c = 0; c < count; ++c) {
      edges.add(elements[i].nodes[c], elements[i].nodes[(c + 1) % count], static_cast<int>(i));
    }
  }
  edges.sort();
  return edges;
}

/// `name(owner)` names a surface element, or the solid element that it bounds.
template <typename Name>
void check_edges(const std::vector<SurfaceElement>& elements, Name name) {
  sorted_edges(elements).for_each([&](std::span<const EdgeSide> sides) {
    if (is_manifold(sides)) return;
    std::ostringstream text;
    text << name(sides.front().owner) << ": its edge between the nodes " << sides.front().low << " and "
         << sides.front().high;
    if (sides.size() == 1) text << " is open: no other face shares it";
    if (sides.size() == 2) text << " is run along in the same direction by " << name(sides[1].owner);
    if (sides.size() > 2) text << " belongs to " << sides.size() << " faces instead of 2";
    throw MeshError(text.str());
  });
}

/// Keeps the nodes that a face uses, in their order.
std::vector<Vector3> compact_nodes(const std::vector<Vector3>& nodes, std::vector<SurfaceElement>& faces) {
  std::vector<int> renumbered(nodes.size(), -1);
  const auto each_node = [&](auto visit) {
    for (SurfaceElement& face : faces) {
      for (int i = 0; i < corner_count(face); ++i) visit(face.nodes[i]);
    }
  };
  each_node([&](int node) { renumbered[node] = 0; });
  std::vector<Vector3> used;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (renumbered[i] < 0) continue;
    renumbered[i] = static_cast<int>(used.size());
    used.push_back(nodes[i]);
  }
  each_node([&](int& node) { node = renumbered[node]; });
  return used;
}

std::string surface_element_name(const Surface& surface, int index) {
  const bool triangle = corner_count(surface.elements[index]) == 3;
  return (triangle ? "triangle " : "quadrilateral ") + std::to_string(index);
}

void check_surface_nodes(const Surface& surface, int index) {
  const SurfaceElement& element = surface.elements[index];
  const auto count = static_cast<std::size_t>(corner_count(element));
  for (std::size_t i = 0; i < count; ++i) {
    const int node = element.nodes[i];
    const auto name = [&] { return surface_element_name(surface, index) + ": node " + std::to_string(node); };
    if (!(node >= 0 && static_cast<std::size_t>(node) < surface.nodes.size())) {
      throw MeshError(name() + " is not one of the " + std::to_string(surface.nodes.size()) + " nodes");
    }
    if (std::count(element.nodes.begin(), element.nodes.begin() + static_cast<std::ptrdiff_t>(i), node)) {
      throw MeshError(name() + " is repeated");
    }
    if (!surface.nodes[node].allFinite()) throw MeshError(name() + " has a coordinate that is not finite");
  }
}

/// A needle with edges in the ratio 1e6 passes; the rounding of a cross product does not.
void check_area(const Surface& surface, int index) {
  const SurfaceElement& element = surface.elements[index];
  const auto node = [&](std::size_t i) -> const Vector3& { return surface.nodes[element.nodes[i]]; };
  const bool triangle = corner_count(element) == 3;
  const Vector3 a = triangle ? node(1) - node(0) : node(2) - node(0);
  const Vector3 b = triangle ? node(2) - node(0) : node(3) - node(1);
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * a.norm() * b.norm();
  if (!(a.cross(b).norm() > rounding)) throw MeshError(surface_element_name(surface, index) + ": has no area");
}

/// Six times the volume between an element and the reference point.  For a quadrilateral the mean
/// of its two ways to be cut into triangles, which is that of the bilinear patch.
double cone(const Surface& surface, const SurfaceElement& element, const Vector3& reference) {
  const auto arm = [&](std::size_t i) -> Vector3 { return surface.nodes[element.nodes[i]] - reference; };
  if (corner_count(element) == 3) return arm(0).dot(arm(1).cross(arm(2)));
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += arm(i).dot(arm((i + 1) % 4).cross(arm((i + 2) % 4)));
  return sum / 2;
}

}  // namespace

Surface boundary_surface(const Mesh& mesh) {
  if (mesh.elements.empty()) throw MeshError("the mesh has no element");
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) check_element(mesh, e);
  Surface surface{.nodes = {}, .elements = outer_faces(mesh)};
  check_edges(surface.elements, [&](int face) { return element_name(mesh, surface.elements[face].element); });
  surface.nodes = compact_nodes(mesh.nodes, surface.elements);
  return surface;
}

void check_closed(const Surface& surface) {
  if (surface.elements.empty()) throw MeshError("the surface has no element");
  for (int i = 0; i < static_cast<int>(surface.elements.size()); ++i) {
    check_surface_nodes(surface, i);
    check_area(surface, i);
  }
  check_edges(surface.elements, [&](int face) { return surface_element_name(surface, face); });
  const Vector3& reference = surface.nodes[surface.elements[0].nodes[0]];
  double volume = 0;
  for (const SurfaceElement& element : surface.elements) volume += cone(surface, element, reference) / 6;
  if (!(volume > 0)) {
    std::ostringstream text;
    text << surface_element_name(surface, 0) << " and the others face inward: they enclose the volume " << volume;
    throw MeshError(text.str());
  }
}

}  // namespace clatter::numeric
