// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/hull.hpp"

#include <libqhull_r/libqhull_r.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace clatter::validation {
namespace {

using numeric::Vector3;

constexpr double on_surface = 1e-9;  // coordinates that a user typed are rounded
constexpr int most_steps = 200;      // each takes a nearer simplex; a few tens suffice

/// The part of a simplex that holds its point nearest to the origin.
struct Nearest {
  std::vector<Vector3> corners;
  Vector3 point = Vector3::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

/// Takes the point of the corners' affine hull nearest to the origin if that point lies among the corners.
void take_if_nearer(const std::vector<Vector3>& corners, Nearest& best) {
  constexpr double rounding = 1e-12;
  const auto count = static_cast<Eigen::Index>(corners.size());
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, count - 1);
  for (Eigen::Index i = 1; i < count; ++i) edges.col(i - 1) = corners[static_cast<std::size_t>(i)] - corners[0];
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> weights(count - 1);
  if (count > 1) weights = edges.colPivHouseholderQr().solve(-corners[0]);
  const bool among = (weights.array() >= -rounding).all() && weights.sum() <= 1 + rounding;
  const Vector3 point = corners[0] + edges.lazyProduct(weights);
  if (among && point.norm() < best.distance) best = {corners, point, point.norm()};
}

/// The nearest of all corners, edges, faces and the whole of a simplex of up to four corners.
Nearest nearest_part(const std::vector<Vector3>& simplex) {
  Nearest best;
  for (unsigned set = 1; set < 1U << simplex.size(); ++set) {
    std::vector<Vector3> corners;
    for (std::size_t i = 0; i < simplex.size(); ++i) {
      if (set >> i & 1U) corners.push_back(simplex[i]);
    }
    take_if_nearer(corners, best);
  }
  return best;
}

/// Whether a plane separates the point from all others by more than 1e-9 of the size.  Gilbert, Johnson and Keerthi
/// (1988): the nearest point of a simplex of points, with the point furthest towards the origin in its place of the
/// next.
bool is_separate(const Vector3& point, const std::vector<Vector3>& others, double size) {
  if (others.empty() || !(size > 0)) return false;
  std::vector<Vector3> arms;
  arms.reserve(others.size());
  for (const Vector3& other : others) arms.emplace_back((other - point) / size);
  Nearest nearest{{arms[0]}, arms[0], arms[0].norm()};
  for (int step = 0; step < most_steps && nearest.distance > on_surface; ++step) {
    const Vector3 towards = nearest.point / nearest.distance;
    const auto support = std::min_element(
        arms.begin(), arms.end(), [&](const Vector3& a, const Vector3& b) { return a.dot(towards) < b.dot(towards); });
    if (support->dot(towards) > on_surface) return true;
    nearest.corners.push_back(*support);
    const Nearest next = nearest_part(nearest.corners);
    if (!(next.distance < nearest.distance)) return false;  // no nearer in double precision
    nearest = next;
  }
  return false;
}

/// The points that differ from all kept before them by more than `same` [m], in their order.  Each is held against
/// those alone that are as near along one slanted direction, along which few points of a body share a place.
std::vector<Vector3> distinct_points(const std::vector<Vector3>& points, double same) {
  const Vector3 slanted = Vector3(1, 0.7548776662466927, 0.5698402909980532).normalized();
  std::vector<std::size_t> order(points.size()), rank(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return slanted.dot(points[i]); });
  for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = k;
  std::vector<char> is_kept(points.size());
  std::vector<Vector3> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto is_near = [&](std::size_t k) {
      return std::fabs(slanted.dot(points[order[k]] - points[i])) <= 2 * same;  // twice: for rounding
    };
    const auto equals = [&](std::size_t k) {
      return is_kept[order[k]] != 0 && (points[order[k]] - points[i]).norm() <= same;
    };
    bool is_new = true;
    for (std::size_t k = rank[i]; is_new && k-- > 0 && is_near(k);) is_new = !equals(k);
    for (std::size_t k = rank[i] + 1; is_new && k < order.size() && is_near(k); ++k) is_new = !equals(k);
    is_kept[i] = is_new ? 1 : 0;
    if (is_new) kept.push_back(points[i]);
  }
  return kept;
}

/// Box about points, along the axes.
struct Extent {
  explicit Extent(const std::vector<Vector3>& points) : low(points.front()), high(low) {
    for (const Vector3& point : points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  /// Largest difference of a coordinate from one of the points'.
  [[nodiscard]] double reach(const Vector3& from) const { return (high - from).cwiseMax(from - low).maxCoeff(); }

  Vector3 low, high;
};

using Triangle = std::array<std::size_t, 3>;

/// A triangulation of the hull by Qhull (Barber, Dobkin and Huhdanpaa, 1996), corners in no order; nothing for points
/// that lie in a plane to rounding.
std::vector<Triangle> hull_triangles(const std::vector<Vector3>& points, const Extent& extent) {
  if (!((extent.high - extent.low).minCoeff() > 0)) return {};
  std::vector<double> scaled;  // to a cube: what a corner and what an edge is does not change
  scaled.reserve(3 * points.size());
  for (const Vector3& point : points) {
    const Vector3 place = (point - extent.low).cwiseQuotient(extent.high - extent.low);
    scaled.insert(scaled.end(), place.begin(), place.end());
  }
  char command[] = "qhull Qt", *messages = nullptr;  // Qhull says nothing that a user of this program could act on
  std::size_t length = 0;
  FILE* const unread = open_memstream(&messages, &length);
  qhT state, *const qh = &state;
  qh_zero(qh, unread);
  const int status =
      qh_new_qhull(qh, 3, static_cast<int>(points.size()), scaled.data(), False, command, nullptr, unread);
  std::vector<Triangle> triangles;
  for (const facetT* facet = status == 0 ? qh->facet_list : nullptr; facet && facet->next; facet = facet->next) {
    Triangle& corners = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto* const vertex = static_cast<const vertexT*>(facet->vertices->e[k].p);
      corners[k] = static_cast<std::size_t>(vertex->point - scaled.data()) / 3;
    }
  }
  qh_freeqhull(qh, qh_ALL);
  int long_left = 0, total_left = 0;
  qh_memfreeshort(qh, &long_left, &total_left);
  std::fclose(unread);
  std::free(messages);
  return triangles;
}

/// For each point those that share an edge of a triangulation of the hull with it, none for a point within it.
/// Nothing at all for points that lie in a plane to rounding.
std::vector<std::vector<Vector3>> hull_neighbours(const std::vector<Vector3>& points, const Extent& extent) {
  const std::vector<Triangle> triangles = hull_triangles(points, extent);
  std::vector<std::vector<Vector3>> neighbours(triangles.empty() ? 0 : points.size());
  for (const Triangle& corners : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {  // each edge is one of two triangles that run about it opposite ways
      const std::size_t from = corners[k];
      neighbours[from].insert(neighbours[from].end(), {points[corners[(k + 1) % 3]], points[corners[(k + 2) % 3]]});
    }
  }
  return neighbours;
}

}  // namespace

bool is_outside_hull(const Vector3& point, const std::vector<Vector3>& points) {
  return !points.empty() && is_separate(point, points, Extent(points).reach(point));
}

std::vector<Vector3> hull_corners(const std::vector<Vector3>& points, double size) {
  const std::vector<Vector3> distinct = distinct_points(points, on_surface * size);
  const Extent extent(distinct);
  const std::vector<std::vector<Vector3>> neighbours = hull_neighbours(distinct, extent);
  if (neighbours.empty()) return distinct;
  std::vector<Vector3> corners;
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    if (is_separate(distinct[i], neighbours[i], extent.reach(distinct[i]))) corners.push_back(distinct[i]);
  }
  return corners;
}

std::vector<HullFace> resting_faces(const std::vector<Vector3>& corners) {
  constexpr double same_normal = 1e-6, sliver = 1e-12;  // of 1, of the square of the reach
  if (corners.empty()) return {};
  const Extent extent(corners);
  Vector3 middle = Vector3::Zero();  // within the hull
  for (const Vector3& corner : corners) middle += corner / static_cast<double>(corners.size());
  const double reach = extent.reach(Vector3::Zero());
  std::vector<HullFace> faces;
  for (const Triangle& triangle : hull_triangles(corners, extent)) {
    const Vector3& a = corners[triangle[0]];
    const Vector3 area = (corners[triangle[1]] - a).cross(corners[triangle[2]] - a);
    if (!(area.norm() > sliver * reach * reach)) continue;
    const Vector3 normal = area.dot(a - middle) > 0 ? area.normalized() : -area.normalized();
    const auto is_same = [&](const HullFace& face) { return (face.normal - normal).norm() <= same_normal; };
    if (std::ranges::none_of(faces, is_same)) faces.push_back({normal, normal.dot(a)});
  }
  std::vector<HullFace> resting;
  for (const HullFace& face : faces) {
    const Vector3 foot = face.distance * face.normal;
    const auto holds = [&](const HullFace& f) { return f.normal.dot(foot) <= f.distance + on_surface * reach; };
    if (std::ranges::all_of(faces, holds)) resting.push_back(face);
  }
  return resting;
}

}  // namespace clatter::validation
