// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/ground_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace clatter::analytic::space {
namespace {

/// Corners nearer to a line than this part of the extent lie on the line.
constexpr double flat = 1e-12;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

std::vector<int> convex_hull(const std::vector<Vector2>& points) {
  const auto at = [&](int i) -> const Vector2& { return points[static_cast<std::size_t>(i)]; };
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(
      order, [&](int i, int j) { return at(i).x() < at(j).x() || (at(i).x() == at(j).x() && at(i).y() < at(j).y()); });
  double extent = 0;
  for (const Vector2& p : points) extent = std::fmax(extent, (p - points.front()).norm());
  if (!(extent > 0)) return points.empty() ? order : std::vector<int>{0};
  std::vector<int> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto i = begin; i != end; ++i) {
      const auto turns_right = [&] {
        const Vector2 side = at(hull.back()) - at(hull[hull.size() - 2]);
        return !(cross(side, at(*i) - at(hull.back())) > flat * extent * side.norm());
      };
      while (hull.size() >= base + 2 && turns_right()) hull.pop_back();
      hull.push_back(*i);
    }
    hull.pop_back();
  };
  add_chain(order.begin(), order.end());
  add_chain(order.rbegin(), order.rend());
  return hull;
}

double margin_inside(const std::vector<Vector2>& corners, const Vector2& point) {
  const std::vector<int> hull = convex_hull(corners);
  if (hull.size() < 3) return -std::numeric_limits<double>::infinity();
  double margin = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2& from = corners[static_cast<std::size_t>(hull[i])];
    const Vector2& to = corners[static_cast<std::size_t>(hull[(i + 1) % hull.size()])];
    margin = std::fmin(margin, cross(to - from, point - from) / (to - from).norm());
  }
  return margin;
}

}  // namespace clatter::analytic::space
