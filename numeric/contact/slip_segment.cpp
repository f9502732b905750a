// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/slip_segment.hpp"

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
  for (const GaussNode& node : gauss_rule(gauss_order(ellipse))) {
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

void add_point(const SlipPatch& patch, const PlanePoint& p, double weight, SlipIntegrals& sum) {
  const SlipVector v{patch.east.at(p), patch.north.at(p)};
  const double speed = std::sqrt(v.square() + patch.rounding * patch.rounding);
  if (!(speed > 0)) return;
  const double force = weight * patch.depth.at(p) * patch.stiffness.at(p) / speed;
  const double east = force * v.east, north = force * v.north;
  sum.add({east, north, east * p.x, east * p.y, north * p.x, north * p.y}, 1);
}

}  // namespace clatter::numeric
