// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/nearest_point.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clatter::analytic::space {

NearestInArea::NearestInArea(std::vector<Vector2> corners, const Matrix2& metric)
    : corners_(std::move(corners)), metric_(metric) {}

bool NearestInArea::contains(const Vector2& x) const {
  if (corners_.empty()) return x.squaredNorm() <= 1;
  const Vector2* from = &corners_.back();
  for (const Vector2& to : corners_) {
    if (!(cross(to - *from, x - *from) >= 0)) return false;
    from = &to;
  }
  return true;
}

NearestInArea::Nearest NearestInArea::to(const Vector2& x) const {
  if (contains(x)) return {.point = x};
  return corners_.empty() ? in_disc(x) : in_polygon(x);
}

NearestInArea::Nearest NearestInArea::in_polygon(const Vector2& x) const {
  Nearest nearest;
  nearest.is_inside = false;
  double least = std::numeric_limits<double>::infinity();
  const Vector2* from = &corners_.back();
  for (const Vector2& to : corners_) {
    const Vector2 side = to - *from, weighted = metric_ * side;
    const double along = weighted.dot(x - *from) / weighted.dot(side), part = std::clamp(along, 0.0, 1.0);
    const Vector2 point = *from + part * side;
    if (const double apart = (x - point).dot(metric_ * (x - point)); apart < least) {
      least = apart;
      nearest.point = point;
      nearest.slope.setZero();
      if (part == along) nearest.slope = side * weighted.transpose() / weighted.dot(side);
    }
    from = &to;
  }
  return nearest;
}

/// (B + λ) q = B x with λ > 0 that makes |q| = 1, by Newton's method for 1/|q|, which is nearly straight.
NearestInArea::Nearest NearestInArea::in_disc(const Vector2& x) const {
  constexpr int most_turns = 60;
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const Eigen::SelfAdjointEigenSolver<Matrix2> axes(metric_);
  const Eigen::Array2d b = axes.eigenvalues().array(), pulled = b * (axes.eigenvectors().transpose() * x).array();
  double push = 0;
  Eigen::Array2d q = pulled / b;
  for (int i = 0; i < most_turns; ++i) {
    const double size = q.matrix().norm();
    if (std::fabs(size - 1) <= rounding) break;
    push += (size - 1) * size * size / (q.square() / (b + push)).sum();
    q = pulled / (b + push);
  }
  Nearest nearest{.point = axes.eigenvectors() * q.matrix().normalized(), .is_inside = false};
  const Vector2 along(-nearest.point.y(), nearest.point.x());
  const Vector2 weighted = metric_ * along;
  nearest.slope = along * weighted.transpose() / (weighted.dot(along) + push);
  return nearest;
}

}  // namespace clatter::analytic::space
