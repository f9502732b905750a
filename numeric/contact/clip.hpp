// SPDX-License-Identifier: GPL-3.0-or-later
// Clipping of surface polygons: the contact polygons of Figs. 3 and 4 of Shan et al. (2005).
#pragma once

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

/// A corner of a contact polygon.
struct ContactCorner {
  Vector3 position;  ///< body axes, from an origin that the polygon's owner chooses near its deepest corner [m]
  double depth = 0;  ///< δ, below the ground [m]
  double rate = 0;   ///< δ̇ [m/s]
};

/// The part of a polygon where `value`, linear over its plane, is positive.
/// Sutherland and Hodgman: each corner with a positive value is kept, each edge between a positive and another
/// value gets a new corner at the zero.  A polygon that is not convex may get edges along the line of zeros that
/// cover each other; signed integrals do not see them.  The new corner is computed from the positive end, so
/// that it does not depend on the direction of the edge.
/// @param out  room for 2 × count corners, not overlapping `in`.
/// @return the number of corners; 0 if nothing is positive.
template <class Value>
int clip(const ContactCorner* in, int count, ContactCorner* out, Value&& value) {
  int size = 0;
  const auto crossing = [&](const ContactCorner& inside, double at_inside, const ContactCorner& outside,
                            double at_outside) {
    const double part = at_inside / (at_inside - at_outside);
    out[size++] = {inside.position + part * (outside.position - inside.position),
                   inside.depth + part * (outside.depth - inside.depth),
                   inside.rate + part * (outside.rate - inside.rate)};
  };
  double at_previous = count > 0 ? value(in[count - 1]) : 0;
  for (int i = 0; i < count; ++i) {
    const ContactCorner& previous = in[i == 0 ? count - 1 : i - 1];
    const double at = value(in[i]);
    if (at > 0) {
      if (!(at_previous > 0)) crossing(in[i], at, previous, at_previous);
      out[size++] = in[i];
    } else if (at_previous > 0) {
      crossing(previous, at_previous, in[i], at);
    }
    at_previous = at;
  }
  return size;
}

}  // namespace clatter::numeric
