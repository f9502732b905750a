// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/slip_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/contact/gauss_rules.hpp"

namespace clatter::numeric {
namespace {

constexpr double far_ellipse = 5;  ///< ρ from which the closed form would cancel more than Gauss's rule errs

/// The slowest place of a segment's slip: |slip + σ change|² + rounding² = |change|² ((σ − at)² + width²).
struct Slowest {
  double at, width;
};

Slowest slowest(const SlipVector& slip, const SlipVector& change, double rounding) {
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

SlipIntegrals in_closed_form(const SlipPatch& patch, const SlipSegment& g, const SlipVector& change,
                             const Slowest& place) {
  const SegmentPolynomials p = polynomials(patch, g, place.at);
  const RootIntegrals r = root_integrals(-1 - place.at, 1 - place.at, place.width);
  const double size = std::sqrt(change.square());
  const SlipVector along{change.east / size, change.north / size};
  // The slip at the slowest place is across its change; by the cross product it does not cancel.
  const double sideways = change.cross(g.slip) / (size * size);
  const SlipVector rest{-sideways * along.north, sideways * along.east};
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

SlipIntegrals by_gauss(const SlipPatch& patch, const SlipSegment& g, const SlipVector& change, double ellipse) {
  const SegmentPolynomials p = polynomials(patch, g, 0);
  SlipIntegrals sum;
  for (const GaussNode& node : gauss_rule(gauss_order(ellipse, patch.digits))) {
    const SlipVector v{g.slip.east + node.at * change.east, g.slip.north + node.at * change.north};
    const double speed = std::sqrt(v.square() + patch.rounding * patch.rounding);
    if (!(speed > 0)) continue;
    const double east = node.weight * v.east / speed, north = node.weight * v.north / speed;
    const double q = p.force.at(node.at), x = p.by_x.at(node.at), y = p.by_y.at(node.at);
    sum.add({q * east, q * north, x * east, y * east, x * north, y * north}, 1);
  }
  return sum;
}

}  // namespace

double segment_ellipse(const SlipVector& slip, const SlipVector& change, double rounding) {
  if (!(change.square() > 0)) return std::numeric_limits<double>::infinity();
  return finite_ellipse(slowest(slip, change, rounding));
}

SlipIntegrals along_segment(const SlipPatch& patch, const SlipSegment& segment) {
  const SlipVector change{patch.east.along(segment.half), patch.north.along(segment.half)};
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
    const SlipVector v = slip(at);
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

  [[nodiscard]] SlipVector slip(double at) const {
    return {g_.slip.east + at * change_.east, g_.slip.north + at * change_.north};
  }

  const SlipSegment& g_;
  double rounding_;
  SlipVector change_;
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

}  // namespace clatter::numeric
