// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/slip_integrals.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "numeric/contact/gauss_rules.hpp"

namespace clatter::numeric {
namespace {

double cross(const PlanePoint& a, const PlanePoint& b) { return a.x * b.y - a.y * b.x; }
PlanePoint minus(const PlanePoint& a, const PlanePoint& b) { return {a.x - b.x, a.y - b.y}; }
PlanePoint between(const PlanePoint& a, const PlanePoint& b, double part) {
  return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}
SlipVector slip_at(const SlipPatch& patch, const PlanePoint& p) { return {patch.east.at(p), patch.north.at(p)}; }

/// What must be known of a patch to choose among the ways.
struct SlipSurvey {
  PlanePoint middle;                  ///< of the polygon's bounding box
  double size = 0;                    ///< largest distance of a corner from the middle [m]
  SlipVector slip;                    ///< at the middle
  double variation = 0, fastest = 0;  ///< of the slip from that, and itself [m/s]
};

/// The patch has corners.
SlipSurvey survey(const SlipPatch& patch) {
  SlipSurvey s;
  PlanePoint low = patch.corners[0], high = low;
  for (int i = 1; i < patch.count; ++i) {
    const PlanePoint& p = patch.corners[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  s.middle = between(low, high, 0.5);
  s.slip = slip_at(patch, s.middle);
  double square = 0, variation = 0;
  for (int i = 0; i < patch.count; ++i) {
    const PlanePoint away = minus(patch.corners[i], s.middle);
    const SlipVector change{patch.east.along(away), patch.north.along(away)};
    square = std::max(square, away.x * away.x + away.y * away.y);
    variation = std::max(variation, change.square());
  }
  s.size = std::sqrt(square);
  s.variation = std::sqrt(variation);
  s.fastest = std::sqrt(s.slip.square()) + s.variation;
  return s;
}

constexpr double least_ellipse = 2.6;   ///< ρ from which Gauss's rule is taken
constexpr double least_part = 2e-8;     ///< of the size: a lower part errs by less than its square
constexpr double flat_part = 1e-15;     ///< of the size: the height of an edge that is rounding
constexpr double no_slip_part = 1e-15;  ///< of the largest slip: below it, rounding

/// Sums over the strips between the polygon's edges and a line across the steepest direction of the slip: along that
/// direction in closed form, across it by Gauss's rule.
class Strips {
 public:
  Strips(const SlipPatch& patch, const SlipSurvey& s) : patch_(patch), size_(s.size) {
    const PlaneLinear &e = patch.east, &n = patch.north;
    const double xx = e.x * e.x + n.x * n.x, yy = e.y * e.y + n.y * n.y, xy = e.x * e.y + n.x * n.y;
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    steep_ = {std::cos(angle), std::sin(angle)};
    rise_ = {e.along(steep_), n.along(steep_)};
    const PlanePoint across{-steep_.y, steep_.x};
    drift_ = {e.along(across), n.along(across)};
    const double speed = std::sqrt(rise_.square());
    const double sideways =
        std::fabs(rise_.cross(s.slip)) / speed + std::fabs(rise_.cross(drift_)) / speed * 2 * s.size;
    // The line on which the slip has no part along its steep change, or the nearest one through the polygon.
    const double middle = turned(s.middle).along, least = middle - rise_.dot(s.slip) / rise_.square();
    reference_ = std::clamp(least, middle - s.size, middle + s.size);
    aligned_ = std::hypot(sideways, patch.rounding) <= no_slip_part * s.fastest;
  }

  SlipIntegrals sum() {
    Corner from = turned(patch_.corners[patch_.count - 1]);
    for (int i = 0; i < patch_.count; ++i) {
      const Corner to = turned(patch_.corners[i]);
      add_edge(from, to);
      from = to;
    }
    return sum_;
  }

 private:
  /// A corner in the coordinates along and across the steep direction.
  struct Corner {
    double along, across;
  };
  /// A side of a strip: along = at + slope × (across − from).
  struct Side {
    double from, at, slope;
    [[nodiscard]] double along(double across) const { return at + slope * (across - from); }
  };
  /// From the reference line to an edge.
  struct Strip {
    Side left, right;
    double sign;
  };

  [[nodiscard]] Corner turned(const PlanePoint& p) const {
    return {steep_.x * p.x + steep_.y * p.y, steep_.x * p.y - steep_.y * p.x};
  }
  [[nodiscard]] PlanePoint back(double along, double across) const {
    return {steep_.x * along - steep_.y * across, steep_.y * along + steep_.x * across};
  }
  [[nodiscard]] SlipVector slip(double along, double across) const { return slip_at(patch_, back(along, across)); }

  /// The signed area between the reference line and the edge.
  void add_edge(const Corner& a, const Corner& b) {
    if (!(std::fabs(a.across - b.across) > flat_part * size_)) return;
    const Side edge{a.across, a.along, (b.along - a.along) / (b.across - a.across)};
    const double low = std::min(a.across, b.across), high = std::max(a.across, b.across);
    add_strip({{a.across, reference_, 0}, edge, b.across > a.across ? 1.0 : -1.0}, low, high);
  }

  /// Cuts where a side crosses the line on which the slip has no part along its steep change, and where it has no part
  /// across.
  void add_strip(const Strip& strip, double low, double high) {
    double cuts[5] = {low, high, low, low, low};
    int count = 2;
    const auto cut_at_zero = [&](double at_low, double at_high) {
      if ((at_low > 0) == (at_high > 0)) return;
      const double cut = low + (high - low) * (at_low / (at_low - at_high));
      if (cut > low && cut < high) cuts[count++] = cut;
    };
    for (const Side* s : {&strip.left, &strip.right}) {
      cut_at_zero(rise_.dot(slip(s->along(low), low)), rise_.dot(slip(s->along(high), high)));
    }
    cut_at_zero(rise_.cross(slip(strip.left.along(low), low)), rise_.cross(slip(strip.left.along(high), high)));
    for (int i = 1; i < count; ++i) {  // std::sort of so few makes g++ 12 warn
      for (int j = i; j > 0 && cuts[j] < cuts[j - 1]; --j) std::swap(cuts[j], cuts[j - 1]);
    }
    for (int i = 1; i < count; ++i) add_part(strip, cuts[i - 1], cuts[i]);
  }

  void add_part(const Strip& strip, double low, double high) {
    if (!(high > low)) return;
    const double ellipse = aligned_ ? std::numeric_limits<double>::infinity() : part_ellipse(strip, low, high);
    if (ellipse < least_ellipse && high - low > least_part * size_) {
      const double middle = (low + high) / 2;
      add_part(strip, low, middle);
      add_part(strip, middle, high);
      return;
    }
    const double half = (high - low) / 2, middle = (high + low) / 2;
    for (const GaussNode& node : gauss_rule(gauss_order(ellipse, patch_.digits))) {
      add_line(strip, middle + half * node.at, half * node.weight);
    }
  }

  /// Bernstein ellipse of the function across, whose singularities are where the slip and v_r vanish together at an
  /// end, or on the way between ends on different sides of the least slip.
  [[nodiscard]] double part_ellipse(const Strip& strip, double low, double high) const {
    const double middle = (low + high) / 2, left = strip.left.along(middle), right = strip.right.along(middle);
    const double at_left = rise_.dot(slip(left, middle)), at_right = rise_.dot(slip(right, middle));
    const double half = (high - low) / 2;
    const auto along_side = [&](const Side& s) {
      const SlipVector change{half * (drift_.east + s.slope * rise_.east),
                              half * (drift_.north + s.slope * rise_.north)};
      return segment_ellipse(slip(s.along(middle), middle), change, patch_.rounding);
    };
    double ellipse = std::min(along_side(strip.left), along_side(strip.right));
    if ((at_left > 0) != (at_right > 0)) {
      const double speed = std::sqrt(rise_.square());
      const SlipVector sideways{rise_.cross(slip(left, middle)) / speed, 0};
      ellipse = std::min(ellipse, segment_ellipse(sideways, {half * rise_.cross(drift_) / speed, 0}, patch_.rounding));
    }
    return ellipse;
  }

  void add_line(const Strip& strip, double across, double weight) {
    const double left = strip.left.along(across), right = strip.right.along(across);
    SlipSegment segment;
    segment.middle = back((left + right) / 2, across);
    segment.half = {steep_.x * (right - left) / 2, steep_.y * (right - left) / 2};
    segment.slip = slip_at(patch_, segment.middle);
    segment.depth_at_middle = patch_.depth.at(segment.middle);
    segment.stiffness_at_middle = patch_.stiffness.at(segment.middle);
    sum_.add(along_segment(patch_, segment), strip.sign * weight * (right - left) / 2);
  }

  const SlipPatch& patch_;
  double size_;              ///< of the polygon [m]
  PlanePoint steep_;         ///< unit vector along which the slip changes most
  SlipVector rise_, drift_;  ///< its slopes along that and across
  double reference_ = 0;     ///< coordinate along of the strips' common side [m]
  bool aligned_ = false;     ///< all slip is along `rise_`, to rounding
  SlipIntegrals sum_;
};

constexpr double least_smooth_ellipse = 3.1;  ///< ρ from which Gauss's rule is taken for a whole triangle
constexpr double cheap_ellipse = 10;          ///< ρ from which that costs less than a sum over the edges
constexpr int rough_order = 4;
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

/// What varies linearly along a ray of a fan: values at its apex, or their changes from there to its end.
struct RayValues {
  PlanePoint place;
  double depth, stiffness, east, north;
};

RayValues ray_values(const SlipPatch& patch, const PlanePoint& p) {
  return {p, patch.depth.at(p), patch.stiffness.at(p), patch.east.at(p), patch.north.at(p)};
}

/// Gauss's rule along the rays from a corner: the integrand at part t of a ray is q/√(|v|² + v_r²), which is summed
/// with the weights 1, t and t², times what is linear in t.  Rays lie side by side, so that loops over them become
/// vectors.
class Fan {
 public:
  Fan(const SlipPatch& patch, int order)
      : apex_(ray_values(patch, patch.corners[0])), slow_(patch.rounding * patch.rounding), rule_(gauss_rule(order)) {}

  void add_triangle(const SlipPatch& patch, const PlanePoint& p, const PlanePoint& q) {
    const RayValues first = ray_values(patch, p), last = ray_values(patch, q);
    const double area = cross(minus(p, apex_.place), minus(q, apex_.place)) / 2;
    if (count_ + rule_.size() > most_rays) sum_up();
    for (const GaussNode& along : rule_) {
      const double part = (1 + along.at) / 2;
      const auto change = [&](double at_first, double at_last, double at_apex) {
        return at_first + part * (at_last - at_first) - at_apex;
      };
      x_[count_] = change(first.place.x, last.place.x, apex_.place.x);
      y_[count_] = change(first.place.y, last.place.y, apex_.place.y);
      depth_[count_] = change(first.depth, last.depth, apex_.depth);
      stiffness_[count_] = change(first.stiffness, last.stiffness, apex_.stiffness);
      east_[count_] = change(first.east, last.east, apex_.east);
      north_[count_] = change(first.north, last.north, apex_.north);
      weight_[count_++] = area / 2 * along.weight;
    }
  }

  [[nodiscard]] SlipIntegrals sum() {
    sum_up();
    return sum_;
  }

 private:
  static constexpr std::size_t most_rays = 2 * most_gauss_nodes;

  /// Adds the rays so far, and begins anew.
  void sum_up() {
    const std::size_t count = count_;
    double once[most_rays], first[most_rays], second[most_rays];  // sums with the weights 1, t and t²
    for (std::size_t i = 0; i < count; ++i) once[i] = first[i] = second[i] = 0;
    for (const GaussNode& node : rule_) {
      const double t = (1 + node.at) / 2, part = node.weight * t;
      for (std::size_t i = 0; i < count; ++i) {
        const double east = apex_.east + t * east_[i], north = apex_.north + t * north_[i];
        const double square = east * east + north * north + slow_;
        const double pressure = (apex_.depth + t * depth_[i]) * (apex_.stiffness + t * stiffness_[i]);
        // Where nothing slips there is no friction: a branch would keep the loop from becoming a vector.
        const double speed = std::sqrt(square > 0 ? square : std::numeric_limits<double>::infinity());
        const double force = weight_[i] * part * pressure / speed;
        once[i] += force;
        first[i] += t * force;
        second[i] += t * t * force;
      }
    }
    const PlanePoint& at = apex_.place;
    for (std::size_t i = 0; i < count; ++i) {
      const double east = apex_.east * once[i] + east_[i] * first[i],
                   north = apex_.north * once[i] + north_[i] * first[i];
      const double east_t = apex_.east * first[i] + east_[i] * second[i];
      const double north_t = apex_.north * first[i] + north_[i] * second[i];
      sum_.add({east, north, at.x * east + x_[i] * east_t, at.y * east + y_[i] * east_t, at.x * north + x_[i] * north_t,
                at.y * north + y_[i] * north_t},
               1);
    }
    count_ = 0;
  }

  RayValues apex_;
  double slow_;
  std::span<const GaussNode> rule_;
  std::size_t count_ = 0;  ///< of the rays that are not summed yet, each from the apex to a place on the far side:
  double x_[most_rays], y_[most_rays], depth_[most_rays], stiffness_[most_rays], east_[most_rays], north_[most_rays];
  double weight_[most_rays];  ///< part of the area
  SlipIntegrals sum_;
};

SlipIntegrals add_up_fan(const SlipPatch& patch, int order) {
  Fan fan(patch, order);
  for (int i = 2; i < patch.count; ++i) fan.add_triangle(patch, patch.corners[i - 1], patch.corners[i]);
  return fan.sum();
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
  assert(!(patch.rounding < 0));
  if (patch.count < 3) return {};
  const SlipSurvey s = survey(patch);
  if (!(s.fastest > 0) || !(s.size > 0)) return {};
  const PlaneLinear& north = patch.north;
  if (north.value == 0 && north.x == 0 && north.y == 0) return one_way_slip_integrals(patch);
  PlanePoint fixed;
  const double ellipse = smooth_ellipse(patch, s);
  if (ellipse < cheap_ellipse && near_fixed_point(patch, s, fixed)) return add_up_edges(patch, fixed);
  if (ellipse >= least_smooth_ellipse) return add_up_fan(patch, gauss_order(ellipse, patch.digits));
  return Strips(patch, s).sum();
}

SlipIntegrals rough_slip_integrals(const SlipPatch& patch) {
  if (patch.count < 3) return {};
  SlipPatch rounded = patch;
  rounded.rounding = std::max(patch.rounding, rough_rounding * survey(patch).variation);
  return add_up_fan(rounded, rough_order);
}

}  // namespace clatter::numeric
