// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/hull.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>

namespace clatter::validation::inline scene {
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

/// Of all corners, edges, faces and the whole of a simplex of up to four corners.
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

}  // namespace

/// Gilbert, Johnson and Keerthi (1988): the nearest point of a simplex of points, with the point furthest towards the
/// origin in its place of the next.
bool is_outside_hull(const Vector3& point, const std::vector<Vector3>& points) {
  std::vector<Vector3> arms;
  double size = 0;
  for (const Vector3& other : points) size = std::max(size, (other - point).cwiseAbs().maxCoeff());
  if (points.empty() || !(size > 0)) return false;
  for (const Vector3& other : points) arms.emplace_back((other - point) / size);
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

}  // namespace clatter::validation::inline scene
