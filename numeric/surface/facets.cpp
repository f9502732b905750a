// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/facets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "numeric/surface/edges.hpp"

namespace clatter::numeric {

namespace {

/// Polygon p has the corners begin[p] … begin[p + 1] − 1.  A corner also stands for the edge from
/// it to the next corner of its polygon.
struct Polygons {
  std::vector<Vector3> nodes;  ///< [m]
  std::vector<int> corners;    ///< indices into nodes
  std::vector<int> begin{0};
  std::vector<int> owner;     ///< polygon of each corner
  std::vector<Vector3> area;  ///< outward, of each polygon [m²]

  [[nodiscard]] int count() const { return static_cast<int>(area.size()); }
  [[nodiscard]] const Vector3& position(int corner) const { return nodes[corners[corner]]; }
  [[nodiscard]] int next(int corner) const {
    const auto p = static_cast<std::size_t>(owner[corner]);
    return corner + 1 < begin[p + 1] ? corner + 1 : begin[p];
  }
};

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

/// The surface's elements, warped quadrilaterals cut into four triangles (facets.hpp).
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

/// For each corner the one whose edge is the same in the other direction; -1 where there is none,
/// or no single one.
std::vector<int> opposite_corners(const Polygons& polygons) {
  const int count = static_cast<int>(polygons.corners.size());
  Edges edges;
  edges.reserve(polygons.corners.size());
  for (int c = 0; c < count; ++c) edges.add(polygons.corners[c], polygons.corners[polygons.next(c)], c);
  edges.sort();
  std::vector<int> opposite(polygons.corners.size(), -1);
  edges.for_each([&](std::span<const EdgeSide> sides) {
    if (!is_manifold(sides)) return;
    opposite[sides[0].owner] = sides[1].owner;
    opposite[sides[1].owner] = sides[0].owner;
  });
  return opposite;
}

constexpr double normal_tolerance = 1e-12;
constexpr double length_tolerance = 1e-12;  // of the surface's size

double size_of(const std::vector<Vector3>& nodes) {
  Eigen::AlignedBox3d box;
  for (const Vector3& node : nodes) box.extend(node);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// Polygons sorted into coplanar, connected groups.
struct Groups {
  std::vector<int> of;       ///< group of each polygon
  std::vector<int> members;  ///< polygons, group by group
  std::vector<int> begin{0};

  [[nodiscard]] int count() const { return static_cast<int>(begin.size()) - 1; }
};

class Grouping {
 public:
  Grouping(const Polygons& polygons, const std::vector<int>& opposite)
      : polygons_(polygons), opposite_(opposite), offset_(length_tolerance * size_of(polygons.nodes)) {}

  [[nodiscard]] Groups separate() const {
    Groups groups;
    for (int p = 0; p < polygons_.count(); ++p) {
      groups.of.push_back(p);
      groups.members.push_back(p);
      groups.begin.push_back(p + 1);
    }
    return groups;
  }

  [[nodiscard]] Groups coplanar() const {
    Groups groups;
    groups.of.assign(polygons_.area.size(), -1);
    groups.members.reserve(polygons_.area.size());
    for (int p = 0; p < polygons_.count(); ++p) {
      if (groups.of[p] < 0) grow(groups, p);
    }
    return groups;
  }

 private:
  [[nodiscard]] bool in_plane(const Vector3& normal, const Vector3& point, int polygon) const {
    const double deviation = (polygons_.area[polygon].stableNormalized() - normal).norm();
    if (!(deviation <= normal_tolerance)) return false;
    for (int c = polygons_.begin[polygon]; c < polygons_.begin[polygon + 1]; ++c) {
      const double off = normal.dot(polygons_.position(c) - point);
      if (!(off <= offset_ && -off <= offset_)) return false;
    }
    return true;
  }

  /// Everything that is reached from the first polygon over edges within its plane.
  void grow(Groups& groups, int first) const {
    const int group = groups.count();
    const Vector3 normal = polygons_.area[first].stableNormalized();
    const Vector3& point = polygons_.position(polygons_.begin[first]);
    groups.of[first] = group;
    std::size_t done = groups.members.size();
    for (groups.members.push_back(first); done < groups.members.size(); ++done) {
      const int polygon = groups.members[done];
      for (int c = polygons_.begin[polygon]; c < polygons_.begin[polygon + 1]; ++c) {
        if (opposite_[c] < 0) continue;
        const int neighbour = polygons_.owner[opposite_[c]];
        if (groups.of[neighbour] >= 0 || !in_plane(normal, point, neighbour)) continue;
        groups.of[neighbour] = group;
        groups.members.push_back(neighbour);
      }
    }
    groups.begin.push_back(static_cast<int>(groups.members.size()));
  }

  const Polygons& polygons_;
  const std::vector<int>& opposite_;
  double offset_;
};

/// The edges between groups, each named by the corner at which it starts.
class Outline {
 public:
  Outline(const Polygons& polygons, const std::vector<int>& opposite, const Groups& groups)
      : polygons_(polygons), opposite_(opposite), groups_(groups) {}

  [[nodiscard]] bool contains(int corner) const {
    return opposite_[corner] < 0 || group(opposite_[corner]) != group(corner);
  }

  /// The next edge of the group's outline: turns about the end of the edge, through the group's
  /// polygons, which also finds the way where the outline touches itself.
  [[nodiscard]] int next(int corner) const {
    int edge = polygons_.next(corner);
    while (!contains(edge)) edge = polygons_.next(opposite_[edge]);
    return edge;
  }

 private:
  [[nodiscard]] int group(int corner) const { return groups_.of[polygons_.owner[corner]]; }

  const Polygons& polygons_;
  const std::vector<int>& opposite_;
  const Groups& groups_;
};

double distance_to_segment(const Vector3& point, const Vector3& from, const Vector3& to) {
  const Vector3 along = to - from, arm = point - from;
  const double square = along.squaredNorm();
  const double share = square > 0 ? std::clamp(arm.dot(along) / square, 0., 1.) : 0;
  return (arm - share * along).norm();
}

/// Finds the nodes within straight edges between two facets.
class StraightNodes {
 public:
  StraightNodes(const Polygons& polygons, const Outline& outline) : polygons_(polygons), outline_(outline) {
    edges_from_.assign(polygons.nodes.size(), 0);
    for (int c = 0; c < corner_count(); ++c) {
      if (outline.contains(c)) ++edges_from_[polygons.corners[c]];
    }
  }

  [[nodiscard]] std::vector<bool> find() const {
    std::vector<bool> straight(polygons_.nodes.size(), false);
    const double tolerance = length_tolerance * size_of(polygons_.nodes);
    for (int c = 0; c < corner_count(); ++c) {
      if (outline_.contains(c) && !shared_by_two(c)) mark_chain(c, tolerance, straight);
    }
    return straight;
  }

 private:
  [[nodiscard]] int corner_count() const { return static_cast<int>(polygons_.corners.size()); }
  [[nodiscard]] bool shared_by_two(int corner) const { return edges_from_[polygons_.corners[corner]] == 2; }

  /// The chain from a node of three or more facets to the next such node separates the same two
  /// facets.  It is judged as a whole, so that small bends cannot add up.
  void mark_chain(int first, double tolerance, std::vector<bool>& straight) const {
    int end = outline_.next(first);
    while (shared_by_two(end)) end = outline_.next(end);
    const Vector3& from = polygons_.position(first);
    const Vector3& to = polygons_.position(end);
    for (int c = outline_.next(first); c != end; c = outline_.next(c)) {
      if (!(distance_to_segment(polygons_.position(c), from, to) <= tolerance)) return;
    }
    for (int c = outline_.next(first); c != end; c = outline_.next(c)) straight[polygons_.corners[c]] = true;
  }

  const Polygons& polygons_;
  const Outline& outline_;
  std::vector<int> edges_from_;  // outline edges that start at each node
};

/// Writes the outlines of the groups, without the dropped nodes; corners still name the polygons'
/// nodes.
class Assembly {
 public:
  Assembly(const Polygons& polygons, const Outline& outline, std::vector<bool> dropped)
      : polygons_(polygons), outline_(outline), dropped_(std::move(dropped)) {
    seen_.assign(polygons.corners.size(), false);
  }

  [[nodiscard]] Facets facets(const Groups& groups) {
    for (int g = 0; g < groups.count(); ++g) {
      Vector3 area = Vector3::Zero();
      const int begin = static_cast<int>(facets_.loops.size());
      for (int m = groups.begin[g]; m < groups.begin[g + 1]; ++m) {
        area += polygons_.area[groups.members[m]];
        add_loops(groups.members[m]);
      }
      const int end = static_cast<int>(facets_.loops.size());
      facets_.facets.push_back({area.stableNormalized(), begin, end});
    }
    use_own_vertices();
    return std::move(facets_);
  }

 private:
  void add_loops(int polygon) {
    for (int c = polygons_.begin[polygon]; c < polygons_.begin[polygon + 1]; ++c) {
      if (seen_[c] || !outline_.contains(c)) continue;
      const int begin = static_cast<int>(facets_.corners.size());
      for (int edge = c; !seen_[edge]; edge = outline_.next(edge)) {
        seen_[edge] = true;
        const int node = polygons_.corners[edge];
        if (!dropped_[node]) facets_.corners.push_back(node);
      }
      facets_.loops.push_back({begin, static_cast<int>(facets_.corners.size())});
    }
  }

  void use_own_vertices() {
    std::vector<int> vertex(polygons_.nodes.size(), -1);
    for (const int node : facets_.corners) vertex[node] = 0;
    for (std::size_t i = 0; i < vertex.size(); ++i) {
      if (vertex[i] < 0) continue;
      vertex[i] = static_cast<int>(facets_.vertices.size());
      facets_.vertices.push_back(polygons_.nodes[i]);
    }
    for (int& corner : facets_.corners) corner = vertex[corner];
  }

  const Polygons& polygons_;
  const Outline& outline_;
  std::vector<bool> dropped_, seen_;
  Facets facets_;
};

}  // namespace

Facets planar_facets(const Surface& surface, bool merge) {
  const Polygons polygons = planar_polygons(surface);
  const std::vector<int> opposite = opposite_corners(polygons);
  const Grouping grouping(polygons, opposite);
  const Groups groups = merge ? grouping.coplanar() : grouping.separate();
  const Outline outline(polygons, opposite, groups);
  std::vector<bool> dropped(polygons.nodes.size(), false);
  if (merge) dropped = StraightNodes(polygons, outline).find();
  return Assembly(polygons, outline, std::move(dropped)).facets(groups);
}

namespace {

constexpr int leaf_size = 4;

}  // namespace

Hierarchy::Hierarchy(const Facets& facets) {
  std::vector<Node> boxes(facets.facets.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    Eigen::AlignedBox3d box;
    facets.for_each_corner(static_cast<int>(f), [&](int vertex) { box.extend(facets.vertices[vertex]); });
    boxes[f].centre = box.center();
    boxes[f].half = box.sizes() / 2;
  }
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes.empty()) build(boxes, 0, static_cast<int>(boxes.size()));
}

int Hierarchy::build(const std::vector<Node>& boxes, int begin, int end) {
  const auto box_of = [&](int i) -> const Node& { return boxes[i]; };
  Eigen::AlignedBox3d box, centres;
  for (int i = begin; i < end; ++i) {
    const Node& node = box_of(order_[i]);
    box.extend(node.centre - node.half);
    box.extend(node.centre + node.half);
    centres.extend(node.centre);
  }
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({box.center(), box.sizes() / 2, begin, end, -1});
  if (end - begin <= leaf_size) return index;
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
    const double at_a = box_of(a).centre[axis], at_b = box_of(b).centre[axis];
    return at_a < at_b || (at_a == at_b && a < b);
  });
  build(boxes, begin, middle);
  const int right = build(boxes, middle, end);
  nodes_[index].right = right;
  return index;
}

}  // namespace clatter::numeric
