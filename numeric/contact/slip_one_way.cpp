// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/slip_one_way.hpp"

#include <cmath>
#include <limits>

#include "numeric/contact/gauss_rules.hpp"
#include "numeric/contact/slip_segment.hpp"

namespace clatter::numeric {
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
