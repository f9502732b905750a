// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/polygons.hpp"

#include <cmath>
#include <span>

#include "numeric/surface/edges.hpp"

namespace clatter::numeric {
namespace {

constexpr double warp_tolerance = 1e-12;  // of the longer diagonal

void add_polygon(Polygons& polygons, std::span<const int> nodes) {
  const auto node = [&](std::size_t i) -> const Vector3& { return polygons.nodes[nodes[i]]; };
  const bool triangle = nodes.size() == 3;
  const Vector3 a = triangle ? node(1) - node(0) : node(2) - node(0);
  const Vector3 b = triangle ? node(2) - node(0) : node(3) - node(1);
  polygons.corners.insert(polygons.corners.end(), nodes.begin(), nodes.end());
  polygons.owner.insert(polygons.owner.end(), nodes.size(), polygons.count());
  polygons.begin.push_back(static_cast<int>(polygons.corners.size()));
  polygons.area.push_back(a.cross(b) / 2);
}

/// Each corner is half the distance between the diagonals off their mean plane.
bool is_warped(const std::vector<Vector3>& nodes, const std::array<int, 4>& quad) {
  const auto node = [&](std::size_t i) -> const Vector3& { return nodes[quad[i]]; };
  const Vector3 a = node(2) - node(0), b = node(3) - node(1), normal = a.cross(b);
  const double off = std::fabs(normal.dot(node(1) - node(0))) / 2;
  return !(off <= warp_tolerance * std::fmax(a.norm(), b.norm()) * normal.norm());
}

void add_warped(Polygons& polygons, const std::array<int, 4>& quad) {
  const auto& nodes = polygons.nodes;
  // Opposite corners first: the same to the bit from whichever corner and way round one starts.
  const Vector3 mean = ((nodes[quad[0]] + nodes[quad[2]]) + (nodes[quad[1]] + nodes[quad[3]])) / 4;
  const int centre = static_cast<int>(nodes.size());
  polygons.nodes.push_back(mean);
  for (std::size_t i = 0; i < 4; ++i) {
    const int triangle[] = {quad[i], quad[(i + 1) % 4], centre};
    add_polygon(polygons, triangle);
  }
}

}  // namespace

Polygons planar_polygons(const Surface& surface) {
  Polygons polygons{.nodes = surface.nodes, .corners = {}, .owner = {}, .area = {}};
  for (const SurfaceElement& element : surface.elements) {
    if (element.nodes[3] < 0) {
      add_polygon(polygons, std::span(element.nodes).first(3));
    } else if (is_warped(polygons.nodes, element.nodes)) {
      add_warped(polygons, element.nodes);
    } else {
      add_polygon(polygons, element.nodes);
    }
  }
  return polygons;
}

std::vector<int> opposite_corners(const Polygons& polygons) {
  const int count = static_cast<int>(polygons.corners.size());
  Edges edges;
  edges.reserve(polygons.corners.size());
  for (int c = 0; c < count; ++c) {
    edges.add(polygons.corners[c], polygons.corners[polygons.next(c)], c);
  }
  edges.sort();
  std::vector<int> opposite(polygons.corners.size(), -1);
  edges.for_each([&](std::span<const EdgeSide> sides) {
    if (!is_manifold(sides)) return;
    opposite[sides[0].owner] = sides[1].owner;
    opposite[sides[1].owner] = sides[0].owner;
  });
  return opposite;
}

}  // namespace clatter::numeric
