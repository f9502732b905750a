// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/hierarchy.hpp"

#include <algorithm>
#include <numeric>

namespace clatter::numeric {
namespace {

constexpr int leaf_size = 4;

}  // namespace

Hierarchy::Hierarchy(const Facets& facets) {
  std::vector<Node> boxes(facets.facets.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    Eigen::AlignedBox3d box;
    facets.for_each_corner(static_cast<int>(f),
                           [&](int vertex) { box.extend(facets.vertices[static_cast<std::size_t>(vertex)]); });
    boxes[f].centre = box.center();
    boxes[f].half = box.sizes() / 2;
  }
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes.empty()) build(boxes, 0, static_cast<int>(boxes.size()));
}

int Hierarchy::build(const std::vector<Node>& boxes, int begin, int end) {
  const auto box_of = [&](int i) -> const Node& { return boxes[static_cast<std::size_t>(i)]; };
  Eigen::AlignedBox3d box, centres;
  for (int i = begin; i < end; ++i) {
    const Node& node = box_of(order_[static_cast<std::size_t>(i)]);
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
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

}  // namespace clatter::numeric
