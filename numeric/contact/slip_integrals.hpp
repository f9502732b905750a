// SPDX-License-Identifier: GPL-3.0-or-later
// Friction over a contact polygon whose points slip in different directions.
#pragma once

#include <cmath>

namespace clatter::numeric {

// Friction of slip in varying directions: integrals along the edges of a contact polygon.

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
  double digits = 15;            ///< that Gauss's rule is to give where it is chosen by them
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

/// A vector along the ground: world x and y.
struct AlongGround {
  double east = 0;
  double north = 0;
  [[nodiscard]] double dot(const AlongGround& other) const { return east * other.east + north * other.north; }
  [[nodiscard]] double cross(const AlongGround& other) const { return east * other.north - north * other.east; }
  [[nodiscard]] double square() const { return dot(*this); }
  [[nodiscard]] double norm() const { return std::hypot(east, north); }
  [[nodiscard]] AlongGround operator*(double factor) const { return {east * factor, north * factor}; }
};

/// A segment: p = middle + σ half, −1 <= σ <= 1.  Pressure (depth + d)(stiffness + f), d and f those of the middle
/// changing with the slopes of the patch; its parts of degree 0, 1 and 2 in them count as force_parts and moment_parts.
struct SlipSegment {
  PlanePoint middle, half;
  AlongGround slip;  ///< at the middle
  double depth = 0, stiffness = 0;
  double depth_at_middle = 0, stiffness_at_middle = 0;
  double force_parts[3] = {1, 1, 1}, moment_parts[3] = {1, 1, 1};
};

/// ∫q s dσ and ∫q s p dσ over the segment.  In closed form, with u = σ − σ₀ from the slowest place,
///     s = (b u + c)/(|b| √(u² + d²)),   ∫uⁿ/√(u² + d²) du by recursion,
/// or by Gauss's rule where the segment is far from that place, since there the closed form would cancel.
[[nodiscard]] SlipIntegrals along_segment(const SlipPatch& patch, const SlipSegment& segment);

/// Parameter of the largest Bernstein ellipse about −1 <= σ <= 1 without a zero of |slip + σ change|² + rounding².
[[nodiscard]] double segment_ellipse(const AlongGround& slip, const AlongGround& change, double rounding);

/// Friction of the triangle between the point of no slip p₀ and a segment, over half of twice its area: with p on the
/// segment, v the slip there, W = |v| and λ from p₀ to p,
///     ∫dσ ∫_0^1 λ q(p₀ + λ(p − p₀)) λ v/√(λ² W² + v_r²) dλ,   v_r > 0,                                  (1)
/// and the same times the place from p₀ on.  q is a polynomial in λ: along the ray closed forms of
/// ∫λⁿ/√(λ² W² + v_r²) dλ; along the segment Gauss's rule, on parts that are halved until the complex zeros of W² +
/// v_r², the only singularities, are far from them.  `segment`'s middle and slip are those from p₀ on; its parts do not
/// count.
[[nodiscard]] SlipIntegrals along_rays(const SlipPatch& patch, const SlipSegment& segment);

/// slip_integrals of a patch whose slip has no part to the north.  With ξ along the slope of the slip and η across, the
/// direction s depends on ξ alone, and the pressure q is a polynomial:
///     ∫q s dA = −∮ s(ξ) [∫q dη] dξ     over the edges,                                                  (1)
/// a polynomial times (ξ − ξ₀)/√((ξ − ξ₀)² + w²) along each, in closed form, or by Gauss's rule where that would
/// cancel.
[[nodiscard]] SlipIntegrals one_way_slip_integrals(const SlipPatch& patch);

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
/// Accuracy: 1e-13 of ∫|q| dA, or 10^−digits of the patch where that is more, times the polygon's size for the moments;
/// against extended precision over polygons, slivers among them, of any place and slopes of the slip.  No error is left
/// that would have to be estimated.
[[nodiscard]] SlipIntegrals slip_integrals(const SlipPatch& patch);

/// The same for estimates: right to some per cent, at a cost that does not depend on the slip.
[[nodiscard]] SlipIntegrals rough_slip_integrals(const SlipPatch& patch);

}  // namespace clatter::numeric
