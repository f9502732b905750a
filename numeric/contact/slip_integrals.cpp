// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/slip_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/contact/gauss_rules.hpp"
#include "numeric/contact/slip_one_way.hpp"
#include "numeric/contact/slip_rays.hpp"
#include "numeric/contact/slip_strips.hpp"
#include "numeric/contact/slip_survey.hpp"

namespace clatter::numeric {
namespace {

constexpr double least_smooth_ellipse = 3.1;  ///< ρ from which Gauss's rule is taken for a whole triangle
constexpr double cheap_ellipse = 10;          ///< ρ from which that costs less than a sum over the edges
constexpr int rough_order = 6;
constexpr double rough_rounding = 0.05;  ///< of the slip's variation
constexpr double near_sizes = 3;         ///< distance of p₀ from the middle, in sizes, up to which (1) cancels little

/// Slip along a segment that lies across the survey's circle with the half length b has its complex zeros at
/// |z| >= √(K² − 1 + (v_r/b)²) half lengths from its middle, K the slip at the middle over its variation.
double smooth_ellipse(const SlipPatch& patch, const SlipSurvey& s) {
  if (!(s.variation > 0)) return std::numeric_limits<double>::infinity();
  const double steady = std::sqrt(s.slip.square()) / s.variation, rounded = patch.rounding / s.variation;
  const double square = std::max(steady * steady - 1, 0.0) + rounded * rounded;
  return square > 1 ? std::sqrt(square) + std::sqrt(square - 1) : 1;
}

SlipIntegrals add_up_fan(const SlipPatch& patch, int order) {
  SlipIntegrals sum;
  const std::span<const GaussNode> rule = gauss_rule(order);
  const PlanePoint& apex = patch.corners[0];
  for (int i = 2; i < patch.count; ++i) {
    const PlanePoint &p = patch.corners[i - 1], &q = patch.corners[i];
    const double area = cross(minus(p, apex), minus(q, apex)) / 2;
    for (const GaussNode& along : rule) {
      const PlanePoint end = between(p, q, (1 + along.at) / 2);
      for (const GaussNode& out : rule) {
        const double part = (1 + out.at) / 2;
        const PlanePoint at = between(apex, end, part);
        add_point(patch, at, area / 2 * along.weight * out.weight * part, sum);
      }
    }
  }
  return sum;
}

/// The point of no slip, if it is near: by elimination with the largest slope as pivot, so that what rounding leaves of
/// the slip there is small however ill-conditioned the slopes are.
bool near_fixed_point(const SlipPatch& patch, const SlipSurvey& s, PlanePoint& fixed) {
  double rows[2][3] = {{patch.east.x, patch.east.y, -s.slip.east}, {patch.north.x, patch.north.y, -s.slip.north}};
  int row = 0, column = 0;
  for (int i = 0; i < 4; ++i) {
    if (std::fabs(rows[i / 2][i % 2]) > std::fabs(rows[row][column])) row = i / 2, column = i % 2;
  }
  const double(&first)[3] = rows[row];
  const double(&second)[3] = rows[1 - row];
  const double factor = second[column] / first[column];
  const double pivot = second[1 - column] - factor * first[1 - column], right = second[2] - factor * first[2];
  if (!(std::fabs(right) <= near_sizes * s.size * std::fabs(pivot)) || pivot == 0) return false;
  const double other = right / pivot;
  const double one = (first[2] - first[1 - column] * other) / first[column];
  if (!(std::hypot(one, other) <= near_sizes * s.size)) return false;
  fixed = {s.middle.x + (column == 0 ? one : other), s.middle.y + (column == 0 ? other : one)};
  return true;
}

/// Equation (1), or the rays between the point of no slip and the edges.
SlipIntegrals add_up_edges(const SlipPatch& patch, const PlanePoint& fixed) {
  SlipIntegrals sum;
  SlipSegment segment;
  segment.depth = patch.depth.at(fixed);
  segment.stiffness = patch.stiffness.at(fixed);
  for (int degree = 0; degree < 3; ++degree) {
    segment.force_parts[degree] = 1.0 / (degree + 2);
    segment.moment_parts[degree] = 1.0 / (degree + 3);
  }
  for (int i = 0; i < patch.count; ++i) {
    const PlanePoint a = minus(patch.corners[i], fixed);
    const PlanePoint b = minus(patch.corners[i + 1 == patch.count ? 0 : i + 1], fixed);
    const double twice_area = cross(a, b);
    if (twice_area == 0) continue;
    segment.middle = between(a, b, 0.5);
    segment.half = {(b.x - a.x) / 2, (b.y - a.y) / 2};
    segment.slip = {patch.east.along(segment.middle), patch.north.along(segment.middle)};
    segment.depth_at_middle = patch.depth.along(segment.middle);
    segment.stiffness_at_middle = patch.stiffness.along(segment.middle);
    sum.add(patch.rounding > 0 ? along_rays(patch, segment) : along_segment(patch, segment), twice_area / 2);
  }
  sum.east_x += fixed.x * sum.east;
  sum.east_y += fixed.y * sum.east;
  sum.north_x += fixed.x * sum.north;
  sum.north_y += fixed.y * sum.north;
  return sum;
}

}  // namespace

SlipIntegrals slip_integrals(const SlipPatch& patch) {
  if (patch.count < 3) return {};
  const SlipSurvey s = survey(patch);
  if (!(s.fastest > 0) || !(s.size > 0)) return {};
  const PlaneLinear& north = patch.north;
  if (north.value == 0 && north.x == 0 && north.y == 0) return one_way_slip_integrals(patch);
  PlanePoint fixed;
  const double ellipse = smooth_ellipse(patch, s);
  if (ellipse < cheap_ellipse && near_fixed_point(patch, s, fixed)) return add_up_edges(patch, fixed);
  if (ellipse >= least_smooth_ellipse) return add_up_fan(patch, gauss_order(ellipse));
  return add_up_strips(patch, s);
}

SlipIntegrals rough_slip_integrals(const SlipPatch& patch) {
  if (patch.count < 3) return {};
  SlipPatch rounded = patch;
  rounded.rounding = std::max(patch.rounding, rough_rounding * survey(patch).variation);
  return add_up_fan(rounded, rough_order);
}

}  // namespace clatter::numeric
