// SPDX-License-Identifier: GPL-3.0-or-later
// Convex bodies without corners: ellipsoids, and capsules.
#pragma once

#include <algorithm>

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

/// An ellipsoid with its axes along x, y, z, or two halves of one with a straight part of the same section in between:
/// a capsule.  The affine map u = centre + S w, S = diag(semiaxes), takes a ball of radius 1, or one that moves from
/// −straight/2 to straight/2 over the semiaxis of x, to it.
struct SmoothShape {
  Vector3 semiaxes{1, 1, 1};         ///< [m], each > 0
  double straight = 0;               ///< length between the two halves, along x [m], >= 0
  Vector3 centre = Vector3::Zero();  ///< of the shape, in whatever frame its owner uses [m]

  /// 2 where the shape has two ends that come down one by one, else 1.
  [[nodiscard]] int ends() const { return straight > 0 ? 2 : 1; }
  /// Centre of the ball, or ellipsoid, at an end: −x first [m].
  [[nodiscard]] Vector3 end_centre(int end) const {
    return centre + Vector3(end == 0 ? -straight / 2 : straight / 2, 0, 0);
  }
  /// The point of an end's whole ball or ellipsoid that lies farthest down, where `normal` points up.
  [[nodiscard]] Vector3 lowest(int end, const Vector3& normal) const {
    const Vector3 stretched = semiaxes.cwiseProduct(normal);
    return end_centre(end) - semiaxes.cwiseProduct(stretched) / stretched.norm();
  }
  /// Largest distance of a point of the shape from the frame's origin [m]; of an ellipsoid whose centre is not there,
  /// an upper bound.
  [[nodiscard]] double reach() const {
    return std::max(end_centre(0).norm(), end_centre(ends() - 1).norm()) + semiaxes.maxCoeff();
  }
  /// Whether all sections are those of balls.
  [[nodiscard]] bool is_ball() const { return semiaxes.x() == semiaxes.y() && semiaxes.y() == semiaxes.z(); }
};

}  // namespace clatter::numeric
