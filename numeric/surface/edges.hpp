// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of polygons that share nodes.
#pragma once

#include <algorithm>
#include <cassert>
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

  /// Sorts by edge, sides of one edge by owner: into places by the lower node, of which few sides share one, then
  /// those.
  void sort() {
    int most = -1;
    for (const EdgeSide& side : sides_) most = std::max(most, side.low);
    std::vector<std::size_t> end(static_cast<std::size_t>(most + 1) + 1, 0);
    for (const EdgeSide& side : sides_) ++end[static_cast<std::size_t>(side.low) + 1];
    for (std::size_t n = 1; n < end.size(); ++n) end[n] += end[n - 1];
    std::vector<EdgeSide> sorted(sides_.size());
    for (const EdgeSide& side : sides_) sorted[end[side.low]++] = side;
    sides_.swap(sorted);
    std::size_t begin = 0;
    for (int n = 0; n <= most; ++n) {
      const std::size_t last = end[n];
      std::sort(sides_.begin() + static_cast<std::ptrdiff_t>(begin), sides_.begin() + static_cast<std::ptrdiff_t>(last),
                is_before);
      begin = last;
    }
  }

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
