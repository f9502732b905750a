// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of polygons that share nodes.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace clatter::numeric {

/// One polygon's side of the edge between the nodes low < high.
struct EdgeSide {
  int low = 0;
  int high = 0;
  int owner = 0;          ///< whatever number the caller gave
  bool reversed = false;  ///< the polygon runs from high to low
};

/// Collects the sides of all polygons, then lists them edge by edge.
class Edges {
 public:
  void reserve(std::size_t sides) { sides_.reserve(sides); }
  void add(int from, int to, int owner) {
    sides_.push_back({std::min(from, to), std::max(from, to), owner, from > to});
  }

  /// Sorts by edge, sides of one edge by owner.
  void sort() { std::sort(sides_.begin(), sides_.end(), is_before); }

  /// Calls visit(std::span<const EdgeSide>) once for each edge.  Call sort() first.
  template <typename Visit>
  void for_each(Visit visit) const {
    assert(std::is_sorted(sides_.begin(), sides_.end(), is_before));
    for (std::size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
      while (end < sides_.size() && sides_[end].low == sides_[begin].low && sides_[end].high == sides_[begin].high) {
        ++end;
      }
      visit(std::span(sides_).subspan(begin, end - begin));
    }
  }

 private:
  static bool is_before(const EdgeSide& a, const EdgeSide& b) {
    return std::tie(a.low, a.high, a.owner) < std::tie(b.low, b.high, b.owner);
  }

  std::vector<EdgeSide> sides_;
};

/// Whether exactly two polygons share the edge, and run along it in opposite directions.
[[nodiscard]] inline bool is_manifold(std::span<const EdgeSide> sides) {
  return sides.size() == 2 && sides[0].reversed != sides[1].reversed;
}

}  // namespace clatter::numeric
