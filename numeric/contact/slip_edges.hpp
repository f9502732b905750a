// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of slip in varying directions: integrals along the edges of a contact polygon.
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

/// A slip velocity [m/s].
struct SlipVector {
  double east = 0, north = 0;
  [[nodiscard]] double dot(const SlipVector& other) const { return east * other.east + north * other.north; }
  [[nodiscard]] double cross(const SlipVector& other) const { return east * other.north - north * other.east; }
  [[nodiscard]] double square() const { return dot(*this); }
};

/// A segment: p = middle + σ half, −1 <= σ <= 1.  Pressure (depth + d)(stiffness + f), d and f those of the middle
/// changing with the slopes of the patch; its parts of degree 0, 1 and 2 in them count as force_parts and moment_parts.
struct SlipSegment {
  PlanePoint middle, half;
  SlipVector slip;  ///< at the middle
  double depth = 0, stiffness = 0;
  double depth_at_middle = 0, stiffness_at_middle = 0;
  double force_parts[3] = {1, 1, 1}, moment_parts[3] = {1, 1, 1};
};

/// ∫q s dσ and ∫q s p dσ over the segment.  In closed form, with u = σ − σ₀ from the slowest place,
///     s = (b u + c)/(|b| √(u² + d²)),   ∫uⁿ/√(u² + d²) du by recursion,
/// or by Gauss's rule where the segment is far from that place, since there the closed form would cancel.
[[nodiscard]] SlipIntegrals along_segment(const SlipPatch& patch, const SlipSegment& segment);

/// Parameter of the largest Bernstein ellipse about −1 <= σ <= 1 without a zero of |slip + σ change|² + rounding².
[[nodiscard]] double segment_ellipse(const SlipVector& slip, const SlipVector& change, double rounding);

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

}  // namespace clatter::numeric
