// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals over a contact polygon, exact because depth, rate and position are linear over its plane.
#pragma once

#include "numeric/contact/clip.hpp"

namespace clatter::numeric {

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
