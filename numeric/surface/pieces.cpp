// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace clatter::numeric {
namespace {

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
  [[nodiscard]] const Vector3& node(auto t, std::size_t k) const {
    return all_.nodes[all_.triangles[static_cast<std::size_t>(t)][k]];
  }
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

}  // namespace

Pieces sorted_pieces(const PiecedTriangles& all) { return Sorter(all).sorted(); }

}  // namespace clatter::numeric
