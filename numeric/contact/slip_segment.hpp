// SPDX-License-Identifier: GPL-3.0-or-later
// Friction along a straight segment: the one-dimensional integrals of slip_integrals.
#pragma once

#include "numeric/contact/slip_integrals.hpp"

namespace clatter::numeric {

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

/// Adds weight × the integrands at p.
void add_point(const SlipPatch& patch, const PlanePoint& p, double weight, SlipIntegrals& sum);

}  // namespace clatter::numeric
