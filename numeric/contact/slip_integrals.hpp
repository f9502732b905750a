// SPDX-License-Identifier: GPL-3.0-or-later
// Friction over a contact polygon whose points slip in different directions.
#pragma once

namespace clatter::numeric {

/// A point, or a vector, of a facet's plane [m].
struct PlanePoint {
  double x = 0, y = 0;
};

/// A function that is linear over a facet's plane.
struct PlaneLinear {
  double value = 0;     ///< at the origin
  double x = 0, y = 0;  ///< its slopes
  [[nodiscard]] double at(const PlanePoint& p) const { return value + (x * p.x + y * p.y); }
  [[nodiscard]] double along(const PlanePoint& p) const { return x * p.x + y * p.y; }
};

/// A polygon of a facet, what presses on it and how it slips.
struct SlipPatch {
  const PlanePoint* corners = nullptr;  ///< counter-clockwise: positive; the origin is one of them or near
  int count = 0;
  PlaneLinear depth, stiffness;  ///< pressure q = depth × stiffness, stiffness = k_G + c_G δ̇
  PlaneLinear east, north;       ///< slip velocity v [m/s]
  double rounding = 0;           ///< v_r: the direction is v/√(|v|² + v_r²) [m/s], >= 0
};

/// ∫q s and ∫q s p over the polygon, s = v/√(|v|² + v_r²); s = 0 where the root is.
struct SlipIntegrals {
  double east = 0, north = 0;
  double east_x = 0, east_y = 0, north_x = 0, north_y = 0;  ///< times a coordinate of the plane

  void add(const SlipIntegrals& other, double weight) {
    east += weight * other.east;
    north += weight * other.north;
    east_x += weight * other.east_x;
    east_y += weight * other.east_y;
    north_x += weight * other.north_x;
    north_y += weight * other.north_y;
  }
};

/// The integrals, whatever the polygon's cut and the slopes of the slip.  With p₀ the point of no slip (v_r = 0):
/// - No slip to the north, as in the plane: a sum over the edges in closed form (one_way_slip_integrals).
/// - Slip that varies little over the polygon, against its own size: Gauss's rule on the triangles of a fan.
///   The direction is analytic up to the complex zeros of |v|² + v_r², whose distance gives the order.
/// - p₀ in or near the polygon, v_r = 0: each homogeneous part F_k, of degree k in p − p₀, of the integrand has
///   div((p − p₀) F_k) = (k + 2) F_k, so that
///       ∫F_k dA = 1/(k + 2) Σ h_e ∫F_k ds     over the edges e, h_e the signed distance of their line from p₀,   (1)
///   with elementary integrals along the edges: polynomials times 1/√quadratic.  Nothing is divided by the slopes'
///   determinant.
/// - The same with v_r > 0: the triangles between p₀ and the edges, in closed form along the rays from p₀, by Gauss's
///   rule along the edges (along_rays).
/// - Else (p₀ far, or none: slip with one steep direction): the closed form of (1) along the steep direction, and
///   across it Gauss's rule on parts that are halved until the complex singularities of the function across are far
///   from them.
/// Accuracy: 1e-13 of ∫|q| dA, times the polygon's size for the moments; against extended precision over polygons,
/// slivers among them, of any place and slopes of the slip.  No error is left that would have to be estimated.
[[nodiscard]] SlipIntegrals slip_integrals(const SlipPatch& patch);

/// The same for estimates: right to some per cent, at a cost that does not depend on the slip.
[[nodiscard]] SlipIntegrals rough_slip_integrals(const SlipPatch& patch);

}  // namespace clatter::numeric
