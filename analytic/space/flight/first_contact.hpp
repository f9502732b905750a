// SPDX-License-Identifier: GPL-3.0-or-later
// The earliest corner of a body in space to reach the ground after an impact.
//
// The flight is cut into pieces of a fraction of a radian.  On each, PointHeights bounds the height of every vertex
// and round part from below: above the ground, the piece is clear.  Otherwise the sign of h″ tells: a concave height
// reaches the ground if its end does, a convex one if its lowest point does; a piece with neither sign is halved.
//
// The axis of a free symmetric top circles its momentum L at the rate |L|/I₁, I₁ across the axis.  A body of revolution
// has the heights of its shape turning steadily with L/I₁, whatever its spin about its own axis: so they are computed.
#pragma once

#include <span>
#include <vector>

#include "analytic/plane/flight.hpp"
#include "analytic/space/flight/free_flight.hpp"

namespace clatter::analytic::space {

// Height above the ground of a body's vertices, rims and ellipsoids during a free flight, and bounds between two
// moments.
//
// With e = Aᵀ z, the vertical in body axes, a vertex at r has
//     h = z + e·r,                                                                                  (1)
// and the lowest point of a rim or ellipsoid, with S of (1) in body.hpp,
//     h = z + e·c − ρ |v|,   v = S e.                                                               (2)
// A sphere is a vertex at its centre, ρ lower: |v| = 1.
// Between two moments, s apart, e is within M₆ s⁶/46080 of the polynomial of degree 5 with the same e, ė, ë at both.
// With ω̇ = B(ω, ω), |B(x, y)| <= γ |x| |y| and w >= |ω| at all times, ė = e × ω gives
//     |e⁽ⁿ⁾| <= M_n = wⁿ (1 + γ)(1 + 2γ) … (1 + (n−1)γ).                                            (3)
// A polynomial is nowhere below its smallest Bernstein coefficient; those of (2) are bounded with the coefficients of
// v, since |v| is convex.

/// A moment of a flight.
struct FlightMoment {
  double time = 0;    ///< [s]
  double centre = 0;  ///< height of the centre of mass [m]
  double rate = 0;    ///< its velocity [m/s]
  Vertical vertical;
};

/// Height of a point at a moment.
struct PointHeight {
  double time = 0;          ///< [s]
  double height = 0;        ///< h [m]
  double velocity = 0;      ///< h′ [m/s]
  double acceleration = 0;  ///< h″ [m/s²]; of a level rim that after the moment, as is h′
};

/// Bounds over a piece of a flight.
struct HeightBounds {
  double lowest = 0;        ///< of h, or of h/t for a point that touches at t = 0
  double least_bend = 0;    ///< of h″
  double largest_bend = 0;  ///< of h″
};

/// A piece of a flight between two moments, as the point sees it.
struct Piece {
  const FlightMoment& start;
  const FlightMoment& end;
  const PointHeight& from;
  const PointHeight& to;
  bool touching = false;  ///< from: h = 0 at t = 0
};

/// Where a point touches the ground or is nearest to it: a vertex, the lowest point of a rim or ellipsoid, or all of a
/// rim that lies level to rounding, no point of it lower than another.
[[nodiscard]] Corner touching_corner(const Body& body, const Quaternion& attitude, int point);
/// Corner::place of the same.
[[nodiscard]] inline Vector3 touching_place(const Body& body, const Quaternion& attitude, int point) {
  return touching_corner(body, attitude, point).place;
}
/// |v| of (2): of a rim the sine of the angle between its plane and the ground; 1 for a vertex and a sphere.  Rounding
/// of the attitude moves the lowest point by that over it.
[[nodiscard]] double steepness(const Body& body, const Quaternion& attitude, int point);

/// The heights of a body's points.
class PointHeights {
 public:
  PointHeights(const Body& body, const FreeFlight& flight);

  [[nodiscard]] int count() const { return body_.points(); }
  /// Whether the point moves over the surface with the attitude in other ways than that of a sphere.
  [[nodiscard]] bool is_round(int point) const {
    return point >= static_cast<int>(body_.vertices.size()) && body_.sphere(point) == nullptr;
  }
  [[nodiscard]] FlightMoment moment(double time) const;
  [[nodiscard]] PointHeight at(int point, const FlightMoment& moment) const;
  [[nodiscard]] HeightBounds bounds(int point, const Piece& piece) const;
  /// As steepness() of the body at a moment.
  [[nodiscard]] double steepness(int point, const FlightMoment& moment) const {
    return is_round(point) ? body_.round(point).across(moment.vertical.direction).norm() : 1;
  }
  /// Largest distance of a point from the centre of mass [m].
  [[nodiscard]] double reach() const { return reach_; }
  /// Bound on how far the point comes below the centre of mass at any time [m].
  [[nodiscard]] double depth(int point) const;
  /// Bound on |e⁽ⁿ⁾| of (3), n <= 6.
  [[nodiscard]] double rate_bound(int n) const { return rates_[n]; }
  /// Bound from below on the height of every point between two moments, however often the body spins in between: the
  /// spin axis turns at axis_speed() at most, and a point lies within its distance across that axis.
  [[nodiscard]] double lowest_between(const FlightMoment& a, const FlightMoment& b) const;
  /// Rounding error of a height at a moment [m].
  [[nodiscard]] double noise(double time) const;

 private:
  [[nodiscard]] double lowest_of_vertex(const Piece& piece, double tolerance) const;
  [[nodiscard]] double lowest_of_round(const Round& round, const Piece& piece, double tolerance) const;
  void bend_of_vertex(const Piece& piece, HeightBounds& bounds) const;
  void bend_of_round(const Round& round, const Piece& piece, HeightBounds& bounds) const;

  const Body& body_;
  const FreeFlight& flight_;
  double reach_;
  double rates_[7];
};

/// A point on the ground at t = 0, with its normal velocity known better than V_z + (ω × r)_z is.
struct Touch {
  int point = 0;
  double normal_velocity = 0;  ///< [m/s]
};

/// Which points reach the ground first, and when.
struct FirstContact {
  FlightEnd end = FlightEnd::no_contact;
  double time = 0;            ///< since departure [s]
  double time_error = 0;      ///< rounding error of time [s]
  int point = 0;              ///< the first; the one that stays for FlightEnd::stays_touching
  std::vector<int> together;  ///< approaching points at height 0 to rounding then, `point` first
  double bracket_low = 0;     ///< certified bracket of the time [s]
  double bracket_high = 0;
  bool is_hop = false;  ///< of the point that departed, so small that time and normal_velocity are relatively accurate
  bool within_margin = false;  ///< the graze is so slight that rounding decides whether it happens
  double normal_velocity = 0;  ///< h′ of `point` then [m/s]
  double velocity_error = 0;   ///< rounding error of normal_velocity [m/s]
  double acceleration = 0;     ///< h″ of `point` then [m/s²]
  NearMiss near_miss;   ///< lowest turning point below a twentieth of the reach, or a bound on many; infinite: none
  int evaluations = 0;  ///< of the rotation
};

/// Earliest time t > 0 at which a vertex, rim or ellipsoid reaches the ground.
/// Points at height 0 to rounding at t = 0 count as touching: they do not arrive then unless they approach.
/// Accuracy of the time: some ulp × (1 + condition number).  Where a point that touches returns after less than a tenth
/// of a radian, its height comes from its Taylor series at t = 0, so that small hops keep their relative accuracy.
/// @throws NumericalError if no contact is found, nor excluded, in 250 000 pieces or a million evaluations, or a root
///         cannot be polished.
[[nodiscard]] FirstContact first_contact(const Body& body, const FreeFlight& flight, std::span<const Touch> touching);

}  // namespace clatter::analytic::space
