// SPDX-License-Identifier: GPL-3.0-or-later
// The point of a convex area that is nearest to another in a given metric.
#pragma once

#include <vector>

#include "analytic/space/flight/body.hpp"

namespace clatter::analytic::space {

/// A convex polygon, or a unit disc about 0 for no corners, in the metric of B: q with (x − q)·B (x − q) least.
class NearestInArea {
 public:
  /// @param corners  counter-clockwise; none: the unit disc
  /// @param metric   B, symmetric positive definite
  NearestInArea(std::vector<Vector2> corners, const Matrix2& metric);

  struct Nearest {
    Vector2 point = Vector2::Zero();      ///< q
    Matrix2 slope = Matrix2::Identity();  ///< dq/dx: of the side, the corner or the arc on which q lies
    bool is_inside = true;                ///< q = x
  };
  [[nodiscard]] Nearest to(const Vector2& x) const;
  /// The same in the area shrunk by `part` about 0.
  [[nodiscard]] Nearest to(const Vector2& x, double part) const {
    Nearest nearest = to(x / part);
    nearest.point = nearest.is_inside ? x : Vector2(part * nearest.point);
    return nearest;
  }

 private:
  [[nodiscard]] bool contains(const Vector2& x) const;
  [[nodiscard]] Nearest in_polygon(const Vector2& x) const;
  [[nodiscard]] Nearest in_disc(const Vector2& x) const;

  std::vector<Vector2> corners_;
  Matrix2 metric_;
};

}  // namespace clatter::analytic::space
