// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/edges.hpp"

#include <algorithm>
#include <tuple>

namespace clatter::numeric {

void Edges::add(int from, int to, int owner) {
  sides_.push_back({std::min(from, to), std::max(from, to), owner, from > to});
}

void Edges::sort() {
  std::sort(sides_.begin(), sides_.end(), [](const EdgeSide& a, const EdgeSide& b) {
    return std::tie(a.low, a.high, a.owner) < std::tie(b.low, b.high, b.owner);
  });
}

bool is_manifold(std::span<const EdgeSide> sides) {
  return sides.size() == 2 && sides[0].reversed != sides[1].reversed;
}

}  // namespace clatter::numeric
