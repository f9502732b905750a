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

constexpr double far_ellipse = 5;  ///< ρ from which the closed form would cancel more than Gauss's rule errs

/// The slowest place of a segment's slip: |slip + σ change|² + rounding² = |change|² ((σ − at)² + width²).
struct Slowest {
  double at, width;
};

Slowest slowest(const AlongGround& slip, const AlongGround& change, double rounding) {
  const double square = change.square();
  const double across = slip.cross(change) / square, rounded = rounding / std::sqrt(square);
  return {-slip.dot(change) / square, std::sqrt(across * across + rounded * rounded)};
}

/// By the distances of the complex zero from the ends, the foci.
double ellipse_of(const Slowest& place) {
  const double square = place.width * place.width, before = place.at + 1, after = place.at - 1;
  const double sum = (std::sqrt(before * before + square) + std::sqrt(after * after + square)) / 2;
  return sum + std::sqrt(std::max(sum * sum - 1, 0.0));
}

double finite_ellipse(const Slowest& place) {
  const double ellipse = ellipse_of(place);
  return std::isfinite(ellipse) ? ellipse : std::numeric_limits<double>::infinity();
}

/// A polynomial of degree up to 3.
struct Cubic {
  double c[4];
  [[nodiscard]] double at(double u) const { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); }
};

/// The integrands' polynomials in u = σ − at.
struct SegmentPolynomials {
  Cubic force, by_x, by_y;
};

SegmentPolynomials polynomials(const SlipPatch& patch, const SlipSegment& g, double at) {
  const double d1 = patch.depth.along(g.half), f1 = patch.stiffness.along(g.half);
  const double d = g.depth_at_middle + at * d1, f = g.stiffness_at_middle + at * f1;
  const double x1 = g.half.x, y1 = g.half.y, x = g.middle.x + at * x1, y = g.middle.y + at * y1;
  const auto pressure = [&](const double(&part)[3]) {
    const double mixed = part[1] * (g.depth * f + g.stiffness * d),
                 mixed1 = part[1] * (g.depth * f1 + g.stiffness * d1);
    return Cubic{{part[0] * g.depth * g.stiffness + mixed + part[2] * d * f, mixed1 + part[2] * (d * f1 + d1 * f),
                  part[2] * d1 * f1, 0}};
  };
  const auto times = [](const Cubic& q, double value, double slope) {
    return Cubic{{q.c[0] * value, q.c[1] * value + q.c[0] * slope, q.c[2] * value + q.c[1] * slope, q.c[2] * slope}};
  };
  const Cubic moment = pressure(g.moment_parts);
  return {pressure(g.force_parts), times(moment, x, x1), times(moment, y, y1)};
}

/// ∫uⁿ/√(u² + d²) du between two places, n from 0 to 4.
struct RootIntegrals {
  double m[5];
};

RootIntegrals root_integrals(double from, double to, double width) {
  const double square = width * width, a = std::sqrt(from * from + square), b = std::sqrt(to * to + square);
  RootIntegrals r;
  r.m[0] = width > 0 ? std::asinh(to / width) - std::asinh(from / width) : 0;
  r.m[1] = b - a;
  double to_power = 1, from_power = 1;
  for (int n = 2; n <= 4; ++n) {
    to_power *= to;
    from_power *= from;
    r.m[n] = (to_power * b - from_power * a - (n - 1) * square * r.m[n - 2]) / n;
  }
  return r;
}

SlipIntegrals in_closed_form(const SlipPatch& patch, const SlipSegment& g, const AlongGround& change,
                             const Slowest& place) {
  const SegmentPolynomials p = polynomials(patch, g, place.at);
  const RootIntegrals r = root_integrals(-1 - place.at, 1 - place.at, place.width);
  const double size = std::sqrt(change.square());
  const AlongGround along{change.east / size, change.north / size};
  // The slip at the slowest place is across its change; by the cross product it does not cancel.
  const double sideways = change.cross(g.slip) / (size * size);
  const AlongGround rest{-sideways * along.north, sideways * along.east};
  const auto even = [&](const Cubic& q) {
    return q.c[0] * r.m[0] + q.c[1] * r.m[1] + q.c[2] * r.m[2] + q.c[3] * r.m[3];
  };
  const auto odd = [&](const Cubic& q) {
    return q.c[0] * r.m[1] + q.c[1] * r.m[2] + q.c[2] * r.m[3] + q.c[3] * r.m[4];
  };
  const double e = even(p.force), o = odd(p.force), ex = even(p.by_x), ox = odd(p.by_x), ey = even(p.by_y),
               oy = odd(p.by_y);
  return {along.east * o + rest.east * e,   along.north * o + rest.north * e,   along.east * ox + rest.east * ex,
          along.east * oy + rest.east * ey, along.north * ox + rest.north * ex, along.north * oy + rest.north * ey};
}

SlipIntegrals by_gauss(const SlipPatch& patch, const SlipSegment& g, const AlongGround& change, double ellipse) {
  const SegmentPolynomials p = polynomials(patch, g, 0);
  SlipIntegrals sum;
  for (const GaussNode& node : gauss_rule(gauss_order(ellipse, patch.digits))) {
    const AlongGround v{g.slip.east + node.at * change.east, g.slip.north + node.at * change.north};
    const double speed = std::sqrt(v.square() + patch.rounding * patch.rounding);
    if (!(speed > 0)) continue;
    const double east = node.weight * v.east / speed, north = node.weight * v.north / speed;
    const double q = p.force.at(node.at), x = p.by_x.at(node.at), y = p.by_y.at(node.at);
    sum.add({q * east, q * north, x * east, y * east, x * north, y * north}, 1);
  }
  return sum;
}

}  // namespace

double segment_ellipse(const AlongGround& slip, const AlongGround& change, double rounding) {
  if (!(change.square() > 0)) return std::numeric_limits<double>::infinity();
  return finite_ellipse(slowest(slip, change, rounding));
}

SlipIntegrals along_segment(const SlipPatch& patch, const SlipSegment& segment) {
  const AlongGround change{patch.east.along(segment.half), patch.north.along(segment.half)};
  if (!(change.square() > 0)) return by_gauss(patch, segment, change, std::numeric_limits<double>::infinity());
  const Slowest place = slowest(segment.slip, change, patch.rounding);
  const double ellipse = finite_ellipse(place);
  return ellipse >= far_ellipse ? by_gauss(patch, segment, change, ellipse)
                                : in_closed_form(patch, segment, change, place);
}

namespace {

constexpr double least_ellipse_along_rays = 2.2;  ///< ρ from which Gauss's rule is taken
constexpr double least_part_of_ray = 1e-15;       ///< of the segment: rounding
constexpr double least_ratio = 0.25;              ///< (W/v_r)² from which the closed forms do not cancel
constexpr int slow_order = 12;                    ///< of Gauss's rule below it, right to 1e-15

/// ∫_0^1 λⁿ/√(λ² W² + v_r²) dλ, n from 2 to 5.
struct RayIntegrals {
  double by_force[3] = {0, 0, 0};   ///< n from 2 to 4
  double by_moment[3] = {0, 0, 0};  ///< n from 3 to 5
};

RayIntegrals closed_ray(double square, double rounding) {
  const double slow = rounding * rounding, end = std::sqrt(square + slow), speed = std::sqrt(square), over = 1 / square;
  const double j0 = std::log((speed + end) / rounding) / speed, j1 = 1 / (end + rounding);
  const double j2 = (end - slow * j0) * over / 2, j3 = (end - 2 * slow * j1) * over / 3;
  const double j4 = (end - 3 * slow * j2) * over / 4, j5 = (end - 4 * slow * j3) * over / 5;
  return {{j2, j3, j4}, {j3, j4, j5}};
}

RayIntegrals slow_ray(double square, double rounding) {
  const double slow = rounding * rounding;
  double j[4] = {0, 0, 0, 0};
  for (const GaussNode& node : gauss_rule(slow_order)) {
    const double part = (1 + node.at) / 2, part_square = part * part;
    double weight = node.weight / 2 * part_square / std::sqrt(part_square * square + slow);
    for (double& integral : j) {
      integral += weight;
      weight *= part;
    }
  }
  return {{j[0], j[1], j[2]}, {j[1], j[2], j[3]}};
}

/// Equation (1) for one segment.
class Rays {
 public:
  Rays(const SlipPatch& patch, const SlipSegment& segment)
      : g_(segment),
        rounding_(patch.rounding), change_{patch.east.along(segment.half), patch.north.along(segment.half)},
        depth_change_(patch.depth.along(segment.half)), stiffness_change_(patch.stiffness.along(segment.half)) {}

  SlipIntegrals sum() {
    add_part(-1, 1);
    return sum_;
  }

 private:
  void add_part(double low, double high) {
    const double middle = (low + high) / 2, half = (high - low) / 2;
    const double ellipse = segment_ellipse(slip(middle), {half * change_.east, half * change_.north}, rounding_);
    if (ellipse < least_ellipse_along_rays && half > least_part_of_ray) {
      add_part(low, middle);
      add_part(middle, high);
      return;
    }
    for (const GaussNode& node : gauss_rule(gauss_order(ellipse))) add_ray(middle + half * node.at, half * node.weight);
  }

  void add_ray(double at, double weight) {
    const AlongGround v = slip(at);
    const double square = v.square();
    const RayIntegrals ray =
        square > least_ratio * rounding_ * rounding_ ? closed_ray(square, rounding_) : slow_ray(square, rounding_);
    const double depth = g_.depth_at_middle + at * depth_change_;
    const double stiffness = g_.stiffness_at_middle + at * stiffness_change_;
    const double constant = g_.depth * g_.stiffness, linear = g_.depth * stiffness + g_.stiffness * depth;
    const auto along_ray = [&](const double(&n)[3]) {
      return weight * (constant * n[0] + linear * n[1] + depth * stiffness * n[2]);
    };
    const double force = along_ray(ray.by_force), moment = along_ray(ray.by_moment);
    const double x = moment * (g_.middle.x + at * g_.half.x), y = moment * (g_.middle.y + at * g_.half.y);
    sum_.add({v.east * force, v.north * force, v.east * x, v.east * y, v.north * x, v.north * y}, 1);
  }

  [[nodiscard]] AlongGround slip(double at) const {
    return {g_.slip.east + at * change_.east, g_.slip.north + at * change_.north};
  }

  const SlipSegment& g_;
  double rounding_;
  AlongGround change_;
  double depth_change_, stiffness_change_;
  SlipIntegrals sum_;
};

}  // namespace

SlipIntegrals along_rays(const SlipPatch& patch, const SlipSegment& segment) { return Rays(patch, segment).sum(); }

namespace {

constexpr double far_ellipse_one_way = 3;  ///< ρ from which the closed form would cancel more than Gauss's rule errs
constexpr int most = 4;                    ///< degree of the polynomials

/// A polynomial along an edge.
struct Polynomial {
  double c[most + 1] = {0, 0, 0, 0, 0};

  [[nodiscard]] double at(double u) const {
    double sum = 0;
    for (int n = most; n >= 0; --n) sum = sum * u + c[n];
    return sum;
  }
  void add(const Polynomial& other, double weight) {
    for (int n = 0; n <= most; ++n) c[n] += weight * other.c[n];
  }
  /// Times value + slope u; the degree is below `most`.
  [[nodiscard]] Polynomial times(double value, double slope) const {
    Polynomial p;
    for (int n = 0; n <= most; ++n) p.c[n] = value * c[n] + (n > 0 ? slope * c[n - 1] : 0);
    return p;
  }
};

/// A function that is linear along an edge.
struct Linear {
  double value, slope;
  [[nodiscard]] Linear from(double at) const { return {value + at * slope, slope}; }
};

/// ∫q dη, ∫q ξ dη and ∫q ζ dη from ζ = 0 to the edge, ζ = η − η₀.
struct EdgePolynomials {
  Polynomial force, by_along, by_across;
};

/// Depth and stiffness on the line ζ = 0, and their slopes across.
struct Edge {
  Linear along, across, depth, stiffness;
  double depth_across, stiffness_across;

  [[nodiscard]] EdgePolynomials polynomials(double at) const {
    const Linear z = across.from(at), x = along.from(at), d = depth.from(at), f = stiffness.from(at);
    Polynomial one;
    one.c[0] = 1;
    const Polynomial z1 = one.times(z.value, z.slope), z2 = z1.times(z.value, z.slope), z3 = z2.times(z.value, z.slope);
    const Polynomial z4 = z3.times(z.value, z.slope);
    const double square = depth_across * stiffness_across;
    const auto sum = [&](const Polynomial& low, const Polynomial& middle, const Polynomial& high, int n) {
      Polynomial p;
      p.add(low.times(d.value, d.slope).times(f.value, f.slope), 1.0 / n);
      p.add(middle.times(d.value, d.slope), stiffness_across / (n + 1));
      p.add(middle.times(f.value, f.slope), depth_across / (n + 1));
      p.add(high, square / (n + 2));
      return p;
    };
    EdgePolynomials p;
    p.force = sum(z1, z2, z3, 1);
    p.by_along = p.force.times(x.value, x.slope);
    p.by_across = sum(z2, z3, z4, 2);
    return p;
  }
};

/// ∫(·) s dσ of the three, s = v/√(v² + v_r²).
struct EdgeSums {
  double force = 0, by_along = 0, by_across = 0;
};

EdgeSums in_closed_form(const Edge& edge, const Linear& slip, double rounding) {
  const double at = -slip.value / slip.slope, width = rounding / std::fabs(slip.slope), square = width * width;
  const EdgePolynomials p = edge.polynomials(at);
  const double from = -1 - at, to = 1 - at, sign = slip.slope > 0 ? 1 : -1;
  const double a = std::sqrt(from * from + square), b = std::sqrt(to * to + square);
  double m[most + 2];  // ∫uⁿ/√(u² + w²) du
  m[0] = width > 0 ? std::asinh(to / width) - std::asinh(from / width) : 0;
  m[1] = (to - from) * (to + from) / (a + b);
  double to_power = 1, from_power = 1;
  for (int n = 2; n <= most + 1; ++n) {
    to_power *= to;
    from_power *= from;
    m[n] = (to_power * b - from_power * a - (n - 1) * square * m[n - 2]) / n;
  }
  EdgeSums sums;
  for (int n = 0; n <= most; ++n) {
    sums.force += sign * p.force.c[n] * m[n + 1];
    sums.by_along += sign * p.by_along.c[n] * m[n + 1];
    sums.by_across += sign * p.by_across.c[n] * m[n + 1];
  }
  return sums;
}

EdgeSums by_gauss(const Edge& edge, const Linear& slip, double rounding, double ellipse) {
  const EdgePolynomials p = edge.polynomials(0);
  EdgeSums sums;
  for (const GaussNode& node : gauss_rule(gauss_order(ellipse))) {
    const double v = slip.value + node.at * slip.slope, speed = std::sqrt(v * v + rounding * rounding);
    if (!(speed > 0)) continue;
    const double weight = node.weight * v / speed;
    sums.force += weight * p.force.at(node.at);
    sums.by_along += weight * p.by_along.at(node.at);
    sums.by_across += weight * p.by_across.at(node.at);
  }
  return sums;
}

/// Equation (1).
class EdgeSum {
 public:
  explicit EdgeSum(const SlipPatch& patch)
      : patch_(patch), steep_(std::hypot(patch.east.x, patch.east.y)),
        along_(steep_ > 0 ? PlanePoint{patch.east.x / steep_, patch.east.y / steep_} : PlanePoint{1, 0}),
        across_{-along_.y, along_.x} {
    const PlanePoint &first = patch.corners[0], &other = patch.corners[patch.count / 2];
    origin_ = {(first.x + other.x) / 2, (first.y + other.y) / 2};
  }

  [[nodiscard]] SlipIntegrals sum() const {
    EdgeSums sums;
    for (int i = 0; i < patch_.count; ++i) {
      const int next = i + 1 == patch_.count ? 0 : i + 1;
      const Linear along = between(along_, i, next);
      if (along.slope != 0) add_edge(along, between(across_, i, next), sums);
    }
    SlipIntegrals out;
    out.east = sums.force;
    out.east_x = origin_.x * sums.force + along_.x * sums.by_along + across_.x * sums.by_across;
    out.east_y = origin_.y * sums.force + along_.y * sums.by_along + across_.y * sums.by_across;
    return out;
  }

 private:
  void add_edge(const Linear& along, const Linear& across, EdgeSums& sums) const {
    const auto on_line = [&](const PlaneLinear& f) {
      const double slope = f.along(along_);
      return Linear{f.at(origin_) + along.value * slope, along.slope * slope};
    };
    const Edge edge{along,
                    across,
                    on_line(patch_.depth),
                    on_line(patch_.stiffness),
                    patch_.depth.along(across_),
                    patch_.stiffness.along(across_)};
    const Linear slip{patch_.east.at(origin_) + along.value * steep_, along.slope * steep_};
    const double ellipse = segment_ellipse({slip.value, 0}, {slip.slope, 0}, patch_.rounding);
    const EdgeSums here = ellipse >= far_ellipse_one_way ? by_gauss(edge, slip, patch_.rounding, ellipse)
                                                         : in_closed_form(edge, slip, patch_.rounding);
    sums.force -= along.slope * here.force;
    sums.by_along -= along.slope * here.by_along;
    sums.by_across -= along.slope * here.by_across;
  }

  /// A coordinate from the origin on, along the edge between two corners.
  [[nodiscard]] Linear between(const PlanePoint& axis, int from, int to) const {
    const auto at = [&](int i) {
      const PlanePoint& p = patch_.corners[i];
      return axis.x * (p.x - origin_.x) + axis.y * (p.y - origin_.y);
    };
    return {(at(to) + at(from)) / 2, (at(to) - at(from)) / 2};
  }

  const SlipPatch& patch_;
  double steep_;               ///< slope of the slip [1/s]
  PlanePoint along_, across_;  ///< axes
  PlanePoint origin_;          ///< between two corners: within the polygon
};

}  // namespace

SlipIntegrals one_way_slip_integrals(const SlipPatch& patch) { return EdgeSum(patch).sum(); }

namespace {

double cross(const PlanePoint& a, const PlanePoint& b) { return a.x * b.y - a.y * b.x; }
PlanePoint minus(const PlanePoint& a, const PlanePoint& b) { return {a.x - b.x, a.y - b.y}; }
PlanePoint between(const PlanePoint& a, const PlanePoint& b, double part) {
  return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}
AlongGround slip_at(const SlipPatch& patch, const PlanePoint& p) { return {patch.east.at(p), patch.north.at(p)}; }

/// What must be known of a patch to choose among the ways.
struct SlipSurvey {
  PlanePoint middle;                  ///< of the polygon's bounding box
  double size = 0;                    ///< largest distance of a corner from the middle [m]
  AlongGround slip;                   ///< at the middle
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
    const AlongGround change{patch.east.along(away), patch.north.along(away)};
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
  [[nodiscard]] AlongGround slip(double along, double across) const { return slip_at(patch_, back(along, across)); }

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
      const AlongGround change{half * (drift_.east + s.slope * rise_.east),
                               half * (drift_.north + s.slope * rise_.north)};
      return segment_ellipse(slip(s.along(middle), middle), change, patch_.rounding);
    };
    double ellipse = std::min(along_side(strip.left), along_side(strip.right));
    if ((at_left > 0) != (at_right > 0)) {
      const double speed = std::sqrt(rise_.square());
      const AlongGround sideways{rise_.cross(slip(left, middle)) / speed, 0};
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
  double size_;               ///< of the polygon [m]
  PlanePoint steep_;          ///< unit vector along which the slip changes most
  AlongGround rise_, drift_;  ///< its slopes along that and across
  double reference_ = 0;      ///< coordinate along of the strips' common side [m]
  bool aligned_ = false;      ///< all slip is along `rise_`, to rounding
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
