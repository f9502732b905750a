// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "numeric/base/errors.hpp"
#include "numeric/files/triangle_files.hpp"

namespace clatter::numeric {
namespace {

using Vector2 = Eigen::Vector2d;

double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

void add_polygon(Triangles& triangles, const std::vector<int>& polygon) {
  if (polygon.size() == 3) {
    triangles.triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  if (polygon.size() < 3) return;
  constexpr std::size_t most = 20'000;  // beyond which the search for ears takes minutes
  if (polygon.size() > most) throw MeshError("a face has " + std::to_string(polygon.size()) + " corners");
  // Seen along the polygon's area it runs counter-clockwise.
  const Vector3& origin = triangles.corners[polygon[0]];
  Vector3 area = Vector3::Zero();
  for (std::size_t i = 0; i + 1 < polygon.size(); ++i)
    area += (triangles.corners[polygon[i]] - origin).cross(triangles.corners[polygon[i + 1]] - origin);
  const Vector3 normal = area.norm() > 0 ? Vector3(area.stableNormalized()) : Vector3::UnitZ();
  const Vector3 across = normal.unitOrthogonal(), third = normal.cross(across);
  std::vector<Vector2> place;
  for (const int corner : polygon) {
    const Vector3 arm = triangles.corners[corner] - origin;
    place.emplace_back(arm.dot(across), arm.dot(third));
  }
  std::vector<std::size_t> left(polygon.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  // The most pointed ear is cut off first, so that corners on a straight edge get no flat triangles if they need not.
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t best = 0;
    double best_shape = -1;
    for (std::size_t i = 0; i < n; ++i) {
      const Vector2 &a = place[left[(i + n - 1) % n]], &b = place[left[i]], &c = place[left[(i + 1) % n]];
      const double twice = turn(a, b, c),
                   longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
      const double shape = longest > 0 ? twice / longest : 0;
      if (!(shape > best_shape) || (twice <= 0 && best_shape >= 0)) continue;
      bool is_ear = true;
      for (std::size_t j = 0; j < n && is_ear && twice > 0; ++j) {
        const Vector2& p = place[left[j]];
        if (j == i || j == (i + 1) % n || j == (i + n - 1) % n || p == a || p == b || p == c) continue;
        is_ear = turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0;
      }
      if (!is_ear) continue;
      best = i;
      best_shape = shape;
      if (n > 64 && shape > 0.1) break;  // good enough where a search for the best would take n³ steps
    }
    triangles.triangles.push_back(
        {polygon[left[(best + n - 1) % n]], polygon[left[best]], polygon[left[(best + 1) % n]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  triangles.triangles.push_back({polygon[left[0]], polygon[left[1]], polygon[left[2]]});
}

}  // namespace clatter::numeric
