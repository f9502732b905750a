// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/repair.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

#include "numeric/base/errors.hpp"
#include "numeric/base/linear_algebra.hpp"
#include "numeric/surface/edges.hpp"

namespace clatter::numeric {

namespace {

// Which of several closed surfaces lies in which: solids, cavities, solids within a solid.

/// Triangles of closed pieces, each facing one way throughout.
struct PiecedTriangles {
  const std::vector<Vector3>& nodes;
  const std::vector<std::array<int, 3>>& triangles;
  const std::vector<int>& piece;  ///< of each triangle, in 0 … count − 1
  int count = 0;
};

/// What to do with each piece.
struct Pieces {
  std::vector<char> turns, keeps;  ///< by piece
  int parts = 0, cavities = 0, nested = 0, overlapping = 0;
  int flat_triangles = 0;    ///< of pieces that enclose nothing, which are not kept
  double shared_volume = 0;  ///< bound on what overlapping pieces have in common [m³]
};

/// A piece within no other faces outward.  One within another is its cavity, or a solid in its cavity, if it faces the
/// other way in the file; else it is left out, since its volume is the other's already.  That pieces cross is found
/// from edges that pierce triangles and from triangles that lie within the other piece.
[[nodiscard]] Pieces sorted_pieces(const PiecedTriangles& all);

using Box = Eigen::AlignedBox3d;

/// Where test points of one piece lie.
struct Places {
  int inside = 0, outside = 0;
};

class Sorter {
 public:
  explicit Sorter(const PiecedTriangles& all) : all_(all) {
    const auto count = static_cast<std::size_t>(all.count);
    begin_.assign(count + 1, 0);
    for (const int p : all.piece) ++begin_[static_cast<std::size_t>(p) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    members_.resize(all.triangles.size());
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t t = 0; t < all.triangles.size(); ++t) members_[next[all.piece[t]]++] = static_cast<int>(t);
    boxes_.resize(count);
    Box whole;
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
      for (const int n : all.triangles[t]) boxes_[all.piece[t]].extend(all.nodes[n]);
    }
    for (const Box& box : boxes_) whole.extend(box);
    size_ = whole.diagonal().norm();
    volumes_.assign(count, 0);
    std::vector<double> sizes(count, 0);
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
      const int p = all.piece[t];
      const Vector3 middle = boxes_[p].center(), a = node(t, 0) - middle, b = node(t, 1) - middle,
                    c = node(t, 2) - middle;
      const double part = a.dot(b.cross(c)) / 6;
      volumes_[p] += part;
      sizes[p] += std::fabs(part);
    }
    for (std::size_t p = 0; p < count; ++p) {
      if (!(std::fabs(volumes_[p]) > 1e-13 * sizes[p])) volumes_[p] = 0;
    }
  }

  [[nodiscard]] Pieces sorted() {
    const auto count = static_cast<std::size_t>(all_.count);
    Pieces pieces{.turns = std::vector<char>(count), .keeps = std::vector<char>(count, 1)};
    std::vector<int> order;
    for (int p = 0; p < all_.count; ++p) {
      if (volumes_[p] != 0) order.push_back(p);
      else pieces.flat_triangles += begin_[p + 1] - begin_[p], pieces.keeps[p] = 0;
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return std::fabs(volumes_[a]) > std::fabs(volumes_[b]); });
    std::vector<int> facing(count);  // +1: outward
    for (std::size_t i = 0; i < order.size(); ++i) {
      const int p = order[i];
      int holder = -1;  // the smallest kept piece about it
      for (std::size_t j = 0; j < i; ++j) {
        const int other = order[j];
        if (!boxes_[p].intersects(boxes_[other])) continue;
        const bool may_hold = boxes_[other].contains(boxes_[p]);
        const Places places = places_in(p, other);
        if (may_hold && places.inside > 0 && places.outside == 0 && !do_cross(p, other)) {
          if (pieces.keeps[other]) holder = other;
        } else if (pieces.keeps[other] && (places.inside > 0 || do_cross(p, other))) {
          ++pieces.overlapping;
          const Box common = boxes_[p].intersection(boxes_[other]);
          pieces.shared_volume += std::min({common.volume(), std::fabs(volumes_[p]), std::fabs(volumes_[other])});
        }
      }
      const int in_file = volumes_[p] > 0 ? 1 : -1;
      facing[p] = 1;
      if (holder >= 0) {
        const int holder_in_file = volumes_[holder] > 0 ? 1 : -1;
        pieces.keeps[p] = in_file != holder_in_file ? 1 : 0;
        facing[p] = -facing[holder];
      }
      if (!pieces.keeps[p]) {
        ++pieces.nested;
        continue;
      }
      pieces.turns[p] = facing[p] != in_file ? 1 : 0;
      ++(facing[p] > 0 ? pieces.parts : pieces.cavities);
    }
    return pieces;
  }

 private:
  [[nodiscard]] const Vector3& node(auto t, std::size_t k) const { return all_.nodes[all_.triangles[t][k]]; }
  [[nodiscard]] Vector3 middle(int t) const { return (node(t, 0) + node(t, 1) + node(t, 2)) / 3; }

  /// How often a piece winds about a point: the solid angles of its triangles (Van Oosterom and Strackee, 1983) over 4
  /// π.
  [[nodiscard]] double winding(const Vector3& point, int piece) const {
    double sum = 0;
    for (int i = begin_[piece]; i < begin_[piece + 1]; ++i) {
      const int t = members_[i];
      const Vector3 a = node(t, 0) - point, b = node(t, 1) - point, c = node(t, 2) - point;
      const double na = a.norm(), nb = b.norm(), nc = c.norm();
      sum += std::atan2(a.dot(b.cross(c)), na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
    }
    return sum / (2 * std::numbers::pi);
  }

  /// Middles of some of a piece's triangles, those near the other piece's surface not counted.
  [[nodiscard]] Places places_in(int piece, int other) const {
    constexpr int most_points = 12;
    constexpr double most_work = 3e6;  // of triangles at all points: what a tenth of a second takes
    const int size = begin_[piece + 1] - begin_[piece], other_size = begin_[other + 1] - begin_[other];
    const int points = std::clamp(static_cast<int>(most_work / other_size), 2, most_points);
    Places places;
    for (int k = 0; k < std::min(points, size); ++k) {
      const Vector3 point =
          middle(members_[begin_[piece] + static_cast<int>(static_cast<long long>(k) * size / std::min(points, size))]);
      if (!boxes_[other].contains(point)) {
        ++places.outside;
        continue;
      }
      const double turns = std::fabs(winding(point, other));
      if (turns > 0.9) ++places.inside;
      else if (turns < 0.1) ++places.outside;
    }
    return places;
  }

  /// Triangles of a piece that reach into a box, by their least x.
  [[nodiscard]] std::vector<std::pair<Box, int>> reaching(int piece, const Box& box) const {
    std::vector<std::pair<Box, int>> found;
    for (int i = begin_[piece]; i < begin_[piece + 1]; ++i) {
      Box own;
      for (std::size_t k = 0; k < 3; ++k) own.extend(node(members_[i], k));
      if (own.intersects(box)) found.emplace_back(own, members_[i]);
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first.min().x() < b.first.min().x(); });
    return found;
  }

  /// Whether an edge of one triangle goes through the inside of the other.
  [[nodiscard]] bool pierces(int one, int other) const {
    const Vector3 normal = (node(other, 1) - node(other, 0)).cross(node(other, 2) - node(other, 0));
    const double area = normal.norm(), near = 1e-9 * size_;
    if (!(area > 0)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 &p = node(one, k), &q = node(one, (k + 1) % 3);
      const double from = normal.dot(p - node(other, 0)) / area, to = normal.dot(q - node(other, 0)) / area;
      if (!((from > near && to < -near) || (from < -near && to > near))) continue;
      const Vector3 at = p + from / (from - to) * (q - p);
      bool is_within = true;
      for (std::size_t e = 0; e < 3 && is_within; ++e) {
        const Vector3 side = node(other, (e + 1) % 3) - node(other, e);
        is_within = normal.dot(side.cross(at - node(other, e))) > near * area * side.norm();
      }
      if (is_within) return true;
    }
    return false;
  }

  [[nodiscard]] bool do_cross(int piece, int other) const {
    const Box common = boxes_[piece].intersection(boxes_[other]);
    const auto mine = reaching(piece, common), others = reaching(other, common);
    long long work = 200'000'000;
    std::size_t first = 0;
    double widest = 0;
    for (const auto& [box, t] : others) widest = std::max(widest, box.sizes().x());
    for (const auto& [box, t] : mine) {
      while (first < others.size() && others[first].first.min().x() < box.min().x() - widest) ++first;
      for (std::size_t j = first; j < others.size() && others[j].first.min().x() <= box.max().x(); ++j) {
        if (--work < 0) return true;  // what is not known is not small
        if (!box.intersects(others[j].first)) continue;
        if (pierces(t, others[j].second) || pierces(others[j].second, t)) return true;
      }
    }
    return false;
  }

  const PiecedTriangles& all_;
  std::vector<int> begin_, members_;  ///< triangles, piece by piece
  std::vector<Box> boxes_;
  std::vector<double> volumes_;  ///< signed; 0: none to rounding [m³]
  double size_ = 0;
};

Pieces sorted_pieces(const PiecedTriangles& all) { return Sorter(all).sorted(); }

using Corners = std::array<int, 3>;

std::string triangle_name(int index) { return "triangle " + std::to_string(index); }

/// Numbers sets of things that are joined one by one.
class Union {
 public:
  explicit Union(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) { parent_[std::max(find(i), find(j))] = std::min(find(i), find(j)); }

 private:
  std::vector<int> parent_;
};

/// For each corner the first at equal coordinates.  An open table of indices, twice as long as the corners.
std::vector<int> first_at_equal_place(const std::vector<Vector3>& corners) {
  const std::size_t length = std::bit_ceil(2 * corners.size() + 2);
  std::vector<int> table(length, -1), first(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::uint64_t hash = 0;
    for (const double x : corners[i])
      hash = (std::rotl(hash, 23) ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15U;
    std::size_t at = (hash ^ hash >> 32) & (length - 1);
    while (table[at] >= 0 && corners[table[at]] != corners[i]) at = (at + 1) & (length - 1);
    if (table[at] < 0) table[at] = static_cast<int>(i);
    first[i] = table[at];
  }
  return first;
}

class Mender {
 public:
  Mender(Triangles&& given, const RepairOptions& options)
      : options_(options), nodes_(std::move(given.corners)), triangles_(std::move(given.triangles)),
        rounding_(given.rounding), file_index_(triangles_.size()) {
    std::iota(file_index_.begin(), file_index_.end(), 0);
  }

  [[nodiscard]] RepairedSurface run() {
    join_equal_corners();
    if (options_.strict) {
      refuse_flat();
      match();
    } else {
      mend();
    }
    return finish();
  }

 private:
  [[nodiscard]] int count() const { return static_cast<int>(triangles_.size()); }
  [[nodiscard]] const Vector3& corner(int triangle, int k) const { return nodes_[triangles_[triangle][k]]; }
  [[nodiscard]] int from(int side) const { return triangles_[side / 3][side % 3]; }
  [[nodiscard]] int to(int side) const { return triangles_[side / 3][(side % 3 + 1) % 3]; }
  /// The corner that a side's triangle has besides.
  [[nodiscard]] int apex(int side) const { return triangles_[side / 3][(side % 3 + 2) % 3]; }

  /// The corners that triangles use, each place once, in the order of their first use.
  void join_equal_corners() {
    for (int t = 0; t < count(); ++t) {
      for (const int c : triangles_[t]) {
        if (c < 0 || static_cast<std::size_t>(c) >= nodes_.size())
          throw MeshError(triangle_name(t) + ": corner " + std::to_string(c) + " is not one of the " +
                          std::to_string(nodes_.size()) + " corners");
        if (!nodes_[c].allFinite()) throw MeshError(triangle_name(t) + ": a coordinate is not finite");
      }
    }
    for (Vector3& node : nodes_) node += Vector3::Zero();  // makes −0 equal to 0
    const std::vector<int> first = first_at_equal_place(nodes_);
    std::vector<int> number(nodes_.size(), -1);
    std::vector<Vector3> used;
    for (Corners& corners : triangles_) {
      for (int& c : corners) {
        int& n = number[first[c]];
        if (n < 0) {
          n = static_cast<int>(used.size());
          used.push_back(nodes_[c]);
        }
        c = n;
      }
    }
    used.shrink_to_fit();
    nodes_ = std::move(used);
    Eigen::AlignedBox3d box;
    for (const Vector3& node : nodes_) box.extend(node);
    size_ = box.isEmpty() ? 0 : box.sizes().maxCoeff();
  }

  static bool is_needle(const Corners& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

  void refuse_flat() const {
    for (int t = 0; t < count(); ++t) {
      if (is_needle(triangles_[t])) throw MeshError(triangle_name(t) + ": two corners are the same point");
      if (is_flat(t)) throw MeshError(triangle_name(t) + ": has no area");
    }
  }

  /// Keeps the triangles for which `keeps(t)` holds.
  int keep(auto keeps) {
    int kept = 0;
    for (int t = 0; t < count(); ++t) {
      if (!keeps(t)) continue;
      triangles_[kept] = triangles_[t];
      file_index_[kept++] = file_index_[t];
    }
    const int lost = count() - kept;
    triangles_.resize(kept);
    file_index_.resize(kept);
    return lost;
  }

  void drop_needles() {
    repairs_.flat += keep([&](int t) { return !is_needle(triangles_[t]); });
  }

  /// Finds for each side that of its neighbour; −1 where there is none, or no single one.
  void match() {
    Edges edges;
    edges.reserve(3 * triangles_.size());
    for (int s = 0; s < 3 * count(); ++s) edges.add(from(s), to(s), s);
    edges.sort();
    opposite_.assign(3 * triangles_.size(), -1);
    unmatched_.clear();
    crowded_.clear();
    edges.for_each([&](std::span<const EdgeSide> sides) {
      if (sides.size() == 2 && apex(sides[0].owner) != apex(sides[1].owner)) {
        opposite_[sides[0].owner] = sides[1].owner;
        opposite_[sides[1].owner] = sides[0].owner;
        return;
      }
      for (const EdgeSide& side : sides) unmatched_.push_back(side.owner);
      if (sides.size() > 3) pair_around(sides);
    });
  }

  /// Neighbours at an edge that parts touch in are the two that bound one wedge of the solid; where the triangles about
  /// the edge do not face each other by turns there are none.
  void pair_around(std::span<const EdgeSide> sides) {
    const Vector3 along = (nodes_[sides[0].high] - nodes_[sides[0].low]).normalized();
    const Vector3 across = along.unitOrthogonal(), third = along.cross(across);
    std::vector<std::pair<double, const EdgeSide*>> about;
    for (const EdgeSide& side : sides) {
      const Vector3 arm = nodes_[apex(side.owner)] - nodes_[side.low];
      about.emplace_back(std::atan2(arm.dot(third), arm.dot(across)), &side);
    }
    std::sort(about.begin(), about.end());
    const std::size_t size = about.size();
    for (std::size_t i = 0; i < size; ++i) {
      if (about[i].second->reversed == about[(i + 1) % size].second->reversed) return;
    }
    crowded_.push_back(sides[0].owner);
    for (std::size_t i = 0; i < size; ++i) {
      if (!about[i].second->reversed) continue;  // the solid of one that is lies at larger angles
      const int one = about[i].second->owner, other = about[(i + 1) % size].second->owner;
      opposite_[one] = other;
      opposite_[other] = one;
    }
  }

  [[nodiscard]] bool is_closed() const { return std::find(opposite_.begin(), opposite_.end(), -1) == opposite_.end(); }

  void mend() {
    drop_needles();
    match();
    if (!unmatched_.empty()) {
      drop_doubled();
      if (!is_closed() && options_.weld > 0) {
        join_near_corners();
        drop_needles();
        match();
        drop_doubled();
        constexpr int most_passes = 8;  // each splits a triangle once
        for (int pass = 0; pass < most_passes && !is_closed() && split_at_corners(); ++pass) match();
        drop_doubled();
      }
    }
    orient();
    flip_caps();
    if (is_closed() && count() > 0) sort_pieces();
  }

  // --- Triangles that lie on another.

  /// One stays of triangles with the same corners; none of a wall that two parts have between them, each its own side.
  void drop_doubled() {
    if (unmatched_.empty()) return;
    std::vector<std::pair<Corners, int>> keys;
    keys.reserve(triangles_.size());
    for (int t = 0; t < count(); ++t) {
      Corners key = triangles_[t];
      std::sort(key.begin(), key.end());
      keys.emplace_back(key, t);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<int> group(triangles_.size());  // the first triangle with the same corners
    std::vector<char> is_mixed(triangles_.size()), dropped(triangles_.size());
    bool is_any_mixed = false, is_any = false;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const int t = keys[i].second;
      const bool is_first = i == 0 || keys[i].first != keys[i - 1].first;
      group[t] = is_first ? t : group[keys[i - 1].second];
      if (is_first) continue;
      is_any = true;
      dropped[t] = 1;
      if (runs_as(t, group[t])) continue;
      is_mixed[group[t]] = 1;
      is_any_mixed = true;
    }
    if (!is_any) return;
    if (is_any_mixed) {
      const std::vector<char> is_wall = inner_walls(group, is_mixed);
      for (int t = 0; t < count(); ++t) {
        if (is_wall[group[t]]) dropped[t] = 1;
      }
    }
    repairs_.doubled += keep([&](int t) { return dropped[t] == 0; });
    match();
  }

  /// Whether two triangles with the same corners face the same way.
  [[nodiscard]] bool runs_as(int one, int other) const {
    const Corners &a = triangles_[one], &b = triangles_[other];
    const auto k = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
    return b[(k + 1) % 3] == a[1];
  }

  /// Which groups that face both ways are walls within the body: two other triangles go on from an edge of them
  /// or of one that is joined to them.
  [[nodiscard]] std::vector<char> inner_walls(const std::vector<int>& group, const std::vector<char>& is_mixed) const {
    using Side = std::tuple<int, int, int>;  // low and high node, group
    std::vector<char> at_wall(nodes_.size());
    for (int t = 0; t < count(); ++t) {
      if (!is_mixed[group[t]]) continue;
      for (const int c : triangles_[t]) at_wall[c] = 1;
    }
    std::vector<Side> sides;
    for (int s = 0; s < 3 * count(); ++s) {
      if (at_wall[from(s)] && at_wall[to(s)])
        sides.emplace_back(std::min(from(s), to(s)), std::max(from(s), to(s)), group[s / 3]);
    }
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    Union walls(triangles_.size());
    std::vector<char> is_inner(triangles_.size());
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      std::vector<int> mixed;
      int others = 0;
      const auto edge = [&](std::size_t i) { return std::pair(std::get<0>(sides[i]), std::get<1>(sides[i])); };
      for (; end < sides.size() && edge(end) == edge(begin); ++end) {
        const int g = std::get<2>(sides[end]);
        if (is_mixed[g]) mixed.push_back(g);
        else ++others;
      }
      if (others == 0 && mixed.size() == 2) walls.join(mixed[0], mixed[1]);
      if (others < 2) continue;
      for (const int g : mixed) is_inner[g] = 1;
    }
    std::vector<char> of_wall(triangles_.size()), all(triangles_.size());
    for (int t = 0; t < count(); ++t) {
      if (is_inner[t]) of_wall[walls.find(t)] = 1;
    }
    for (int t = 0; t < count(); ++t) all[t] = is_mixed[t] && of_wall[walls.find(t)] ? 1 : 0;
    return all;
  }

  // --- Corners that lie near each other or near an edge.

  [[nodiscard]] std::vector<int> unmatched_corners() const {
    std::vector<int> found;
    for (const int side : unmatched_) {
      if (opposite_[side] >= 0) continue;
      found.push_back(from(side));
      found.push_back(to(side));
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  void note_moved(int node, double distance) {
    if (moved_.empty()) moved_.assign(nodes_.size(), 0);
    moved_[node] = std::max(moved_[node], distance);
  }

  /// Each corner at an unmatched edge becomes the first that is near enough.  Candidates are found along a slanted
  /// direction, along which few corners of a body share a place.
  void join_near_corners() {
    const double near = options_.weld * size_;
    const Vector3 slanted = Vector3(1, 0.7548776662466927, 0.5698402909980532).normalized();
    std::vector<std::pair<double, int>> along;
    for (const int c : unmatched_corners()) along.emplace_back(slanted.dot(nodes_[c]), c);
    std::sort(along.begin(), along.end());
    std::vector<int> becomes(nodes_.size());
    std::iota(becomes.begin(), becomes.end(), 0);
    std::vector<std::pair<int, int>> near_pairs;
    for (std::size_t i = 0; i < along.size(); ++i) {
      for (std::size_t j = i + 1; j < along.size() && along[j].first - along[i].first <= near; ++j) {
        const int one = along[i].second, other = along[j].second;
        if ((nodes_[one] - nodes_[other]).norm() <= near)
          near_pairs.emplace_back(std::max(one, other), std::min(one, other));
      }
    }
    std::sort(near_pairs.begin(), near_pairs.end());
    for (const auto& [later, earlier] : near_pairs) {
      if (becomes[later] != later || becomes[earlier] != earlier) continue;
      becomes[later] = earlier;
      ++repairs_.joined;
      note_moved(earlier, (nodes_[later] - nodes_[earlier]).norm());
    }
    for (Corners& triangle : triangles_) {
      for (int& c : triangle) c = becomes[c];
    }
  }

  /// A corner at an unmatched edge that lies on another unmatched edge splits that one's triangle.
  bool split_at_corners() {
    const double near = options_.weld * size_;
    std::vector<int> by_x = unmatched_corners();
    std::sort(by_x.begin(), by_x.end(), [&](int a, int b) { return nodes_[a].x() < nodes_[b].x(); });
    std::vector<char> is_split(triangles_.size());
    bool any = false;
    for (const int side : std::vector<int>(unmatched_)) {
      if (opposite_[side] >= 0 || is_split[side / 3] || split_work_ <= 0) continue;
      const int a = from(side), b = to(side), c = apex(side);
      const Vector3 along = nodes_[b] - nodes_[a];
      const double low = std::min(nodes_[a].x(), nodes_[b].x()) - near,
                   high = std::max(nodes_[a].x(), nodes_[b].x()) + near;
      std::vector<std::pair<double, int>> between;
      auto next = std::lower_bound(by_x.begin(), by_x.end(), low, [&](int n, double x) { return nodes_[n].x() < x; });
      for (; next != by_x.end() && nodes_[*next].x() <= high; ++next, --split_work_) {
        if (*next == a || *next == b || *next == c) continue;
        const Vector3 arm = nodes_[*next] - nodes_[a];
        const double share = arm.dot(along) / along.squaredNorm(), off = (arm - share * along).norm();
        if (!(share > 0 && share < 1 && off <= near)) continue;
        between.emplace_back(share, *next);
      }
      if (between.empty()) continue;
      std::sort(between.begin(), between.end());
      for (const auto& [share, node] : between) {
        const Vector3 arm = nodes_[node] - nodes_[a];
        const double off = (arm - share * along).norm();
        if (off > 1e-14 * size_) ++repairs_.joined;
        note_moved(node, off);
      }
      any = true;
      is_split[side / 3] = 1;
      int last = a;
      const int index = file_index_[side / 3];
      for (const auto& [share, node] : between) {
        triangles_.push_back({last, node, c});
        file_index_.push_back(index);
        is_split.push_back(0);
        last = node;
      }
      triangles_[side / 3] = {last, b, c};
    }
    return any;
  }

  // --- Which side is outside.

  [[nodiscard]] double cone(int t) const {
    const Vector3 a = corner(t, 0) - apex_, b = corner(t, 1) - apex_, c = corner(t, 2) - apex_;
    return a.dot(b.cross(c)) / 6;
  }

  void turn(int t) {
    std::swap(triangles_[t][1], triangles_[t][2]);
    is_turned_[t] ^= 1;
  }

  /// The piece of each triangle: those that are reached over edges, each piece with its triangles facing one way where
  /// it has two sides, that of most.
  void orient() {
    is_turned_.assign(triangles_.size(), 0);
    piece_.assign(triangles_.size(), -1);
    pieces_ = 0;
    std::vector<int> members;
    for (int first = 0; first < count(); ++first) {
      if (piece_[first] >= 0) continue;
      members.assign(1, first);
      piece_[first] = pieces_;
      std::vector<int> against;
      bool has_two_sides = true;
      for (std::size_t done = 0; done < members.size(); ++done) {
        const int t = members[done];
        for (int s = 3 * t; s < 3 * t + 3; ++s) {
          const int other = opposite_[s];
          if (other < 0) continue;
          const bool agrees = from(s) == to(other);
          const bool wants = is_turned_[t] != (agrees ? 0 : 1);
          const int u = other / 3;
          if (piece_[u] < 0) {
            piece_[u] = pieces_;
            is_turned_[u] = wants ? 1 : 0;
            if (wants) against.push_back(u);
            members.push_back(u);
          } else if ((is_turned_[u] != 0) != wants) {
            has_two_sides = false;
          }
        }
      }
      const bool turns_others = 2 * against.size() > members.size();
      for (const int t : members) {
        const bool turns = has_two_sides && (is_turned_[t] != 0) != turns_others;
        is_turned_[t] = 0;
        if (turns) turn(t);
      }
      ++pieces_;
    }
    if (std::find(is_turned_.begin(), is_turned_.end(), 1) != is_turned_.end()) match();
  }

  /// Turns whole pieces outward or inward by which lies in which, and leaves out solids within another.
  void sort_pieces() {
    const Pieces pieces = sorted_pieces({nodes_, triangles_, piece_, pieces_});
    repairs_.parts = pieces.parts;
    repairs_.cavities = pieces.cavities;
    repairs_.nested = pieces.nested;
    repairs_.overlapping = pieces.overlapping;
    shared_ = pieces.shared_volume;
    for (int t = 0; t < count(); ++t) {
      if (pieces.turns[piece_[t]]) turn(t);
    }
    repairs_.turned = 0;
    for (int t = 0; t < count(); ++t) {
      if (is_turned_[t] && pieces.keeps[piece_[t]]) ++repairs_.turned;
    }
    repairs_.doubled += pieces.flat_triangles;
    const bool all = std::all_of(pieces.keeps.begin(), pieces.keeps.end(), [](char kept) { return kept != 0; });
    if (!all) keep([&](int t) { return pieces.keeps[piece_[t]] != 0; });
    match();
    repairs_.touching = static_cast<int>(crowded_.size());
    if (!crowded_.empty() && is_closed()) part_corners();
  }

  /// Gives each part that touches another in an edge corners of its own there.
  void part_corners() {
    Union fans(3 * triangles_.size());  // of sides, each for the corner at which it starts
    const auto next = [](int side) { return side % 3 == 2 ? side - 2 : side + 1; };
    for (int s = 0; s < 3 * count(); ++s) {
      fans.join(s, next(opposite_[s]));
      fans.join(next(s), opposite_[s]);
    }
    std::vector<int> node_of(3 * triangles_.size(), -1);
    std::vector<char> is_taken(nodes_.size());
    for (int s = 0; s < 3 * count(); ++s) {
      const int fan = fans.find(s), node = from(s);
      if (node_of[fan] >= 0) continue;
      node_of[fan] = node;
      if (is_taken[node]) {
        node_of[fan] = static_cast<int>(nodes_.size());
        nodes_.push_back(Vector3(nodes_[node]));
        if (!moved_.empty()) moved_.push_back(moved_[node]);
      }
      is_taken[node] = 1;
    }
    for (int s = 0; s < 3 * count(); ++s) triangles_[s / 3][s % 3] = node_of[fans.find(s)];
  }

  // --- Triangles whose corners lie on a line.

  /// As check_closed sees it.
  [[nodiscard]] bool is_flat(int t) const {
    const Vector3 a = corner(t, 1) - corner(t, 0), b = corner(t, 2) - corner(t, 0);
    return !(a.cross(b).norm() > 32 * std::numeric_limits<double>::epsilon() * a.norm() * b.norm());
  }

  /// A flat triangle's long edge is no edge of its neighbour, in which the middle corner lies: that is cut in two
  /// there.
  ///     (a, b, c) flat, c between a and b, and (b, a, d)  →  (a, d, c), (d, b, c)
  /// Long edges only become shorter, so this ends.
  void flip_caps() {
    std::vector<int> flat;
    for (int t = 0; t < count(); ++t) {
      if (is_flat(t)) flat.push_back(t);
    }
    if (flat.empty() || !is_closed()) return;
    repairs_.flat += static_cast<int>(flat.size());
    std::vector<char> is_gone(triangles_.size());
    for (std::size_t steps = 100 * flat.size() + 100; !flat.empty() && steps > 0; --steps) {
      const int t = flat.back();
      flat.pop_back();
      if (is_gone[t] || !is_flat(t)) continue;
      const auto length = [&](int k) { return (corner(t, (k + 1) % 3) - corner(t, k)).squaredNorm(); };
      int k = 0;
      for (const int other : {1, 2}) {
        if (length(other) > length(k)) k = other;
      }
      const int side = 3 * t + k, partner = opposite_[side];
      if (partner < 0) return;
      const int u = partner / 3, a = from(side), b = to(side), c = apex(side), d = apex(partner);
      const auto next = [](int s) { return s % 3 == 2 ? s - 2 : s + 1; };
      const int bc = opposite_[next(side)], ca = opposite_[next(next(side))];
      const int ad = opposite_[next(partner)], db = opposite_[next(next(partner))];
      if (c == d) {  // the two are one sheet with nothing between
        is_gone[t] = is_gone[u] = 1;
        link(bc, db);
        link(ca, ad);
        continue;
      }
      triangles_[t] = {a, d, c};
      triangles_[u] = {d, b, c};
      link(3 * t, ad);
      link(3 * t + 1, 3 * u + 2);
      link(3 * t + 2, ca);
      link(3 * u, db);
      link(3 * u + 1, bc);
      flat.push_back(t);
      flat.push_back(u);
    }
    std::vector<int> kept_piece;
    std::vector<char> kept_turn;
    for (int t = 0; t < count(); ++t) {
      if (is_gone[t]) continue;
      kept_piece.push_back(piece_[t]);
      kept_turn.push_back(is_turned_[t]);
    }
    keep([&](int t) { return is_gone[t] == 0; });
    piece_ = kept_piece;
    is_turned_ = kept_turn;
    match();
  }

  void link(int one, int other) {
    if (one >= 0) opposite_[one] = other;
    if (other >= 0) opposite_[other] = one;
  }

  // --- What came out.

  /// To first order a surface that moves by δ changes the volume by at most ∮ δ dA, and ∫ x² dV by ∮ x² δ dA.
  void estimate_errors(const std::vector<Vector3>& nodes) {
    if (triangles_.empty()) return;
    constexpr double eps = std::numeric_limits<double>::epsilon();
    Eigen::AlignedBox3d box;
    for (const Vector3& node : nodes) box.extend(node);
    apex_ = box.center();
    double volume = 0, size = 0, moved = 0, moments = 0;
    const double reach = box.diagonal().norm();
    for (int t = 0; t < count(); ++t) {
      const double part = cone(t);
      volume += part;
      size += std::fabs(part);
      double shift = 0, far = 0;
      for (int k = 0; k < 3; ++k) {
        const int n = triangles_[t][k];
        const double rounding = (rounding_ + eps) * nodes[n].norm();
        shift = std::max(shift, rounding + (moved_.empty() ? 0 : moved_[n]));
        far = std::max(far, (nodes[n] - apex_).squaredNorm());
      }
      const double area = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm() / 2;
      moved += shift * area;
      moments += shift * area * far;
    }
    const double sums = 16 * eps * size;
    repairs_.volume = volume;
    repairs_.volume_error = moved + sums + shared_;
    // An axis through the centre is at most as far from a point as the box about the body reaches.
    repairs_.moment_error = std::max(4 * moments, 0.) + (sums + shared_) * reach * reach;
  }

  /// In the words of check_closed, with the numbers that triangles have in the file and with the place.
  void refuse_unmatched() const {
    bool is_matched = true;
    for (int s = 0; s < 3 * count() && is_matched; ++s) is_matched = opposite_[s] >= 0 && from(s) == to(opposite_[s]);
    if (is_matched) return;
    Edges edges;
    for (int s = 0; s < 3 * count(); ++s) edges.add(from(s), to(s), s);
    edges.sort();
    edges.for_each([&](std::span<const EdgeSide> sides) {
      const int s = sides[0].owner;
      if (is_manifold(sides) || (sides.size() > 3 && opposite_[s] >= 0)) return;
      std::ostringstream text;
      const auto place = [&](int node) {
        const Vector3& at = nodes_[node];
        text << "(" << at.x() << ", " << at.y() << ", " << at.z() << ")";
      };
      text << triangle_name(file_index_[s / 3]) << ": its edge from ";
      place(from(s));
      text << " to ";
      place(to(s));
      text << " m";
      if (sides.size() == 1) text << " is open: no other triangle shares it";
      if (sides.size() == 2)
        text << " is run along in the same direction by " << triangle_name(file_index_[sides[1].owner / 3]);
      if (sides.size() > 2) text << " belongs to " << sides.size() << " faces instead of 2";
      throw MeshError(text.str());
    });
  }

  [[nodiscard]] RepairedSurface finish() {
    refuse_unmatched();
    RepairedSurface done;
    std::vector<int> number(nodes_.size(), -1);
    done.surface.elements.reserve(triangles_.size());
    for (int t = 0; t < count(); ++t) {
      SurfaceElement element{.element = file_index_[t]};
      for (std::size_t k = 0; k < 3; ++k) {
        int& n = number[triangles_[t][k]];
        if (n < 0) {
          n = static_cast<int>(done.surface.nodes.size());
          done.surface.nodes.push_back(nodes_[triangles_[t][k]]);
        }
        element.nodes[k] = n;
      }
      done.surface.elements.push_back(element);
    }
    check_closed(done.surface);
    if (options_.strict) refuse_pieces();
    estimate_errors(nodes_);
    done.repairs = repairs_;
    return done;
  }

  void refuse_pieces() {
    orient();
    const Pieces pieces = sorted_pieces({nodes_, triangles_, piece_, pieces_});
    repairs_.parts = pieces.parts;
    repairs_.cavities = pieces.cavities;
    if (pieces.nested + pieces.overlapping > 0)
      throw MeshError("has solids that lie within each other or overlap: what they share would count twice");
  }

  RepairOptions options_;
  std::vector<Vector3> nodes_;
  std::vector<Corners> triangles_;
  double rounding_;
  std::vector<int> file_index_;  ///< of each triangle
  std::vector<int> opposite_;    ///< side 3 t + k runs from corner k of triangle t to the next
  std::vector<int> unmatched_;   ///< sides at edges that are not two triangles'
  std::vector<int> crowded_;     ///< one side of each edge that pair_around sorted
  std::vector<double> moved_;    ///< how far each node was moved, or another that it stands for [m]; empty: none
  std::vector<int> piece_;
  std::vector<char> is_turned_;
  int pieces_ = 0;
  long long split_work_ = 200'000'000;  ///< candidates to look at: surfaces with so many gaps stay open
  double size_ = 0, shared_ = 0;
  Vector3 apex_ = Vector3::Zero();
  Repairs repairs_;
};

std::string counted(int count, const std::string& one, const std::string& many, const std::string& what) {
  return std::to_string(count) + " " + (count == 1 ? one : many) + " " + what;
}

}  // namespace

std::string Repairs::words() const {
  std::string all;
  const auto add = [&](int count, const std::string& one, const std::string& many, const std::string& what) {
    if (count > 0) all += (all.empty() ? "" : ", ") + counted(count, one, many, what);
  };
  add(joined, "corner", "corners", "joined");
  add(flat, "flat triangle", "flat triangles", "left out");
  add(doubled, "doubled triangle", "doubled triangles", "left out");
  add(turned, "triangle", "triangles", "turned outward");
  add(touching, "edge", "edges", "where parts touch taken apart");
  add(nested, "solid within another", "solids within another", "left out");
  add(overlapping, "pair", "pairs", "of parts overlap, what they share counts twice");
  return all.empty() ? "nothing repaired" : all;
}

RepairedSurface repaired(Triangles triangles, const RepairOptions& options) {
  detail::require(options.weld >= 0, "weld", options.weld, "finite and at least 0");
  if (triangles.triangles.empty()) throw MeshError("the surface has no element");
  return Mender(std::move(triangles), options).run();
}

}  // namespace clatter::numeric
