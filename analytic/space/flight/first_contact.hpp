// SPDX-License-Identifier: GPL-3.0-or-later
// The earliest corner of a body in space to reach the ground after an impact.
//
// The flight is cut into pieces of a fraction of a radian.  On each, point_height.hpp bounds the height of every vertex
// and round part from below: above the ground, the piece is clear.  Otherwise the sign of h″ tells: a concave height
// reaches the ground if its end does, a convex one if its lowest point does; a piece with neither sign is halved.
//
// The axis of a free symmetric top circles its momentum L at the rate |L|/I₁, I₁ across the axis.  A body of revolution
// has the heights of its shape turning steadily with L/I₁, whatever its spin about its own axis: so they are computed.
#pragma once

#include <span>
#include <vector>

#include "analytic/plane/flight.hpp"
#include "analytic/space/flight/point_height.hpp"

namespace clatter::analytic::space {

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
