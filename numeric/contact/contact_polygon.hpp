// SPDX-License-Identifier: GPL-3.0-or-later
// The contact polygons of Figs. 3 and 4 of Shan et al. (2005): clipping, and integrals over them, exact because depth,
// rate and position are linear over their plane.
#pragma once

#include <cassert>

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
int clip(const ContactCorner* in, int count, ContactCorner* out, auto&& value) {
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
  assert(size <= 2 * count);
  return size;
}

/// Values of a linear function at the corners of a triangle, with their sum.
struct CornerValues {
  double p, q, r;
  double sum = p + q + r;
};
[[nodiscard]] inline CornerValues products(const CornerValues& a, const CornerValues& b) {
  return {a.p * b.p, a.q * b.q, a.r * b.r};
}
/// Means over the triangle: ∫ab and ∫abc over its area.
[[nodiscard]] inline double mean(const CornerValues& a, const CornerValues& b) {
  return (a.sum * b.sum + products(a, b).sum) / 12;
}
[[nodiscard]] inline double mean(const CornerValues& a, const CornerValues& b, const CornerValues& c) {
  const CornerValues bc = products(b, c);
  return (a.sum * b.sum * c.sum + a.sum * bc.sum + b.sum * products(a, c).sum + c.sum * products(a, b).sum +
          2 * products(a, bc).sum) /
         60;
}

/// What the force, moment, powers and energy are made of; δ depth, δ̇ rate, u position in the body frame.
struct LoadIntegrals {
  double depth = 0;                               ///< ∫δ [m³]
  double depth_rate = 0;                          ///< ∫δδ̇
  double depth_squared = 0;                       ///< ∫δ²
  double depth_rate_squared = 0;                  ///< ∫δδ̇²
  Vector3 depth_position = Vector3::Zero();       ///< ∫δu
  Vector3 depth_rate_position = Vector3::Zero();  ///< ∫δδ̇u

  void add(const LoadIntegrals& other, double weight);
};

/// What the rates of change of force and pressure centre need besides.
struct RateIntegrals {
  double rate = 0;                                   ///< ∫δ̇
  double rate_squared = 0;                           ///< ∫δ̇²
  Vector3 rate_position = Vector3::Zero();           ///< ∫δ̇u
  Vector3 rate_squared_position = Vector3::Zero();   ///< ∫δ̇²u
  Matrix3 depth_position_squared = Matrix3::Zero();  ///< ∫δuuᵀ

  void add(const RateIntegrals& other, double weight);
};

/// A clipped polygon on its facet.
struct ContactPolygon {
  const ContactCorner* corners;
  int count;
  const Vector3& normal;  ///< of the facet, unit
  const Vector3& origin;  ///< of the corners' positions, body frame [m]
};

/// The integrals over the polygon, by the closed forms for products of up to three linear functions
/// over the triangles of a fan:
///     ∫a   = A/3 Σa
///     ∫ab  = A/12 (ΣaΣb + Σab)
///     ∫abc = A/60 (ΣaΣbΣc + ΣaΣbc + ΣbΣac + ΣcΣab + 2Σabc)
/// A is signed by the normal, so that polygons that are not convex come out right.  The integrals are formed with
/// positions from the polygon's origin and then shifted: a patch much smaller than the body keeps its digits.
[[nodiscard]] LoadIntegrals load_integrals(const ContactPolygon& polygon);
[[nodiscard]] RateIntegrals rate_integrals(const ContactPolygon& polygon);

/// ∫δ² and ∫δδ̇ alone.
struct DepthIntegrals {
  double depth_squared = 0;
  double depth_rate = 0;
};
[[nodiscard]] DepthIntegrals depth_integrals(const ContactPolygon& polygon);

}  // namespace clatter::numeric
