// SPDX-License-Identifier: GPL-3.0-or-later
// The area with which a level face touches the ground, and integrals of pressure and slip over it.
//
// Pressure is linear and does not pull, q(x) = max(0, c₀ + c₁ ξ + c₂ η), with x = centre + unit (ξ, η).  The part of
// the area with q > 0 is a convex polygon, or a disc less a segment.  There the points of a body that slides with u and
// turns with w slip in the direction
//     d = s/|s|,   s = u + w ẑ × (ξ, η),                                                               (1)
// which is that of a turn about the pole ẑ × u/w.  About the pole integrands are homogeneous, so that integrals over
// the area are integrals along its boundary: in closed form on a side, by Gauss's rule on arcs that are short beside
// their distance from the pole.  A pole far outside the area would cancel digits: there d is smooth, and d − u/|u|
// is integrated by Gauss's rule.
#pragma once

#include <vector>

#include "analytic/space/flight/body.hpp"

namespace clatter::analytic::space {

/// A convex area of the ground.
struct ContactArea {
  std::vector<Vector2> corners;  ///< of a polygon, counter-clockwise; of a disc its centre alone [m]
  double radius = 0;             ///< of a disc; 0: a polygon [m]

  /// Whether a force at `point` can be the resultant of pushes on the area [m].
  [[nodiscard]] bool contains(const Vector2& point) const;
  [[nodiscard]] Vector2 middle() const;  ///< mean of the corners [m]
  [[nodiscard]] double extent() const;   ///< largest distance from it [m]
};

/// The part of a contact area that a linear pressure pushes.  Lengths are in units of `unit` from `centre`.
class PressedArea {
 public:
  explicit PressedArea(const ContactArea& area);

  [[nodiscard]] const Vector2& centre() const { return centre_; }  ///< inside the area [m]
  [[nodiscard]] double unit() const { return unit_; }              ///< largest distance from it [m]

  /// Keeps what q of c = `pressure` pushes; returns whether that is the whole area.
  bool press(const Vector3& pressure);
  [[nodiscard]] bool is_empty() const { return sides_.empty() && arc_.is_empty(); }

  /// ∫ g gᵀ dA, g = (1, ξ, η).
  [[nodiscard]] Matrix3 moments() const;
  /// ∫ (d_x, d_y, ξ d_y − η d_x)ᵀ gᵀ dA of (1), (u, w) ≠ 0; times c: direction and couple of slip, weighted with q.
  /// Accuracy: 5e-14 of the moments of the whole area.
  [[nodiscard]] Matrix3 slip_moments(const Vector2& slip, double spin) const;

 private:
  struct Side {
    Vector2 from, to;
  };
  struct Arc {
    double from = 0, to = 0;  ///< angles of the unit circle [rad]
    [[nodiscard]] bool is_empty() const { return !(from < to); }
  };
  void press_disc(const Vector3& pressure);
  void see_from_within();
  [[nodiscard]] Matrix3 moments_within() const;
  [[nodiscard]] Matrix3 slip_moments_within(const Vector2& slip, double spin) const;

  std::vector<Vector2> corners_;  ///< none: a disc
  Vector2 centre_;
  double unit_;
  std::vector<Side> sides_;  ///< from origin_
  Arc arc_;
  Vector2 origin_ = Vector2::Zero();  ///< of what is pushed, if that is a part of a polygon
  double extent_ = 1;                 ///< its size
};

}  // namespace clatter::analytic::space
