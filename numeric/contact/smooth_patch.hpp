// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature over the parts of a unit ball and of a unit cylinder that lie below the ground.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "numeric/base/linear_algebra.hpp"
#include "numeric/contact/gauss_rules.hpp"

namespace clatter::numeric {

/// A function that is linear in space: value + slope·p.
struct SpaceLinear {
  double value = 0;
  Vector3 slope = Vector3::Zero();
  [[nodiscard]] double at(const Vector3& p) const { return value + slope.dot(p); }
};

/// Half-spaces, in each of which a linear function is positive.
class HalfSpaces {
 public:
  static constexpr int most = 5;
  void add(const SpaceLinear& positive) { all_[count_++] = positive; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const SpaceLinear& operator[](int i) const { return all_[i]; }
  /// Whether a point lies in all of them, that of index `but` left out.
  [[nodiscard]] bool contain(const Vector3& p, int but = -1) const {
    for (int i = 0; i < count_; ++i) {
      if (i != but && !((*this)[i].at(p) > 0)) return false;
    }
    return true;
  }

 private:
  std::array<SpaceLinear, most> all_;
  int count_ = 0;
};

/// Part of a circle on the unit sphere: middle + a cos α + b sin α, from <= α <= to.
struct SphereArc {
  Vector3 middle, a, b;
  double from = 0, to = 0;

  [[nodiscard]] Vector3 at(double angle) const;
  [[nodiscard]] Vector3 rate(double angle) const { return b * std::cos(angle) - a * std::sin(angle); }
};

/// The boundary of the part of the unit sphere about (0, 0, 1) that lies in half-spaces.  Points near the sphere's
/// lowest point, the origin, keep their digits: ζ = p.z is the height over it.
struct SphereBoundary {
  static constexpr int most_arcs = 2 * HalfSpaces::most * HalfSpaces::most;
  std::array<SphereArc, most_arcs> arcs;
  int count = 0;
  bool has_top = false;  ///< whether (0, 0, 2) lies in the part

  explicit SphereBoundary(const HalfSpaces& half_spaces);
};

/// A point of a surface and what area it stands for.
struct SurfacePoint {
  Vector3 place;
  double area;
};

/// Where the curves from a point of the sphere to a point of its boundary lie, and what area they sweep.  Low on the
/// sphere those are over a line along the ground, which needs no trigonometric function,
///     p(λ) = (c + λ(b − c))_xy,   dA = λ [(b − c) × db]_z dλ/(1 − p_z);                                (1)
/// elsewhere they lie along the great circle from c to b, φ = the angle between them, seen from the centre
///     p(λ) = [sin((1 − λ)φ) c + sin(λφ) b]/sin φ,   dA = (sin λφ/sin φ)(φ/sin φ) |c, b, db| dλ.        (2)
class SphereRay {
 public:
  static constexpr double low = 0.2;  ///< height of all points below which (1) serves
  /// @param rate  of `end` along the boundary, which has the part on its left
  /// @param is_low  by (1); the same for all rays from a place, but for the lowest, where (1) and (2) are one curve
  SphereRay(const Vector3& from, const Vector3& end, const Vector3& rate, bool is_low);
  /// The area is that of d(part).
  [[nodiscard]] SurfacePoint at(double part) const;

 private:
  Vector3 from_, end_, way_;
  bool is_low_;
  double area_ = 0;
  double half_ = 0, sine_ = 0, cosine_ = 1;  ///< half the angle [rad], its sine and cosine
  double inverse_sine_ = 0;                  ///< of the angle; 0: the ray has no length
};

/// Gauss nodes over a ray that give 10^−digits of what is smooth on the sphere.
/// @param highest  of its points, at least
/// @param length  along the ground, at least
[[nodiscard]] int ray_order(double highest, double length, double digits);

/// How finely a cap is integrated over: Gauss's rule along the height in equal `parts`, the trapezoidal rule around.
struct CapRule {
  int heights = 3, around = 6, parts = 1;
};

/// Heights of a zone of the unit sphere, 0 <= low < high <= 2.
struct Zone {
  double low = 0, high = 0;
};

/// Calls visit(p, area) at the points of a rule over a zone; the cap ζ < h is {0, h}:
///     ∫f dA = ∫dζ ∫f dψ,   p = (ρ cos ψ, ρ sin ψ, ζ),   ρ² = ζ(2 − ζ).
/// Exact where f is a polynomial in p of a degree below `around` and 2 × heights.
void over_zone(const Zone& zone, const CapRule& rule, auto&& visit) {
  const double step = 2 * std::numbers::pi / rule.around, cosine = std::cos(step), sine = std::sin(step);
  const double half = (zone.high - zone.low) / (2 * rule.parts);
  for (int part = 0; part < rule.parts; ++part) {
    for (const GaussNode& node : gauss_rule(rule.heights)) {
      const double z = zone.low + half * (2 * part + 1 + node.at), rho = std::sqrt(z * (2 - z));
      const double area = half * node.weight * step;
      double x = rho, y = 0;
      for (int i = 0; i < rule.around; ++i) {
        visit(Vector3(x, y, z), area);
        const double next = cosine * x - sine * y;
        y = sine * x + cosine * y;
        x = next;
      }
    }
  }
}

/// Gauss nodes that integrate products of some sines and cosines, whose arguments change by 2 × half_angle, to
/// rounding.
[[nodiscard]] inline int trigonometric_order(double half_angle) {
  constexpr std::array<double, 13> below{0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 1.0, 1.2, 1.4, 1.6};
  const auto next = std::upper_bound(below.begin(), below.end(), half_angle);
  return next == below.end() ? 20 : 4 + static_cast<int>(next - below.begin());
}

/// The same over the part of the sphere in half-spaces: the fans between its lowest point and the arcs of the boundary,
/// whose areas have signs, so that it matters not where that point lies.  Exact to rounding for polynomials of low
/// degree.
void over_part(const HalfSpaces& half_spaces, auto&& visit) {
  constexpr double piece = std::numbers::pi;
  const SphereBoundary boundary(half_spaces);
  for (int i = 0; i < boundary.count; ++i) {
    const SphereArc& arc = boundary.arcs[i];
    const int pieces = std::max(1, static_cast<int>(std::ceil((arc.to - arc.from) / piece)));
    const double half = (arc.to - arc.from) / (2 * pieces);
    const int around = trigonometric_order(half);
    const double highest = std::min(arc.middle.z() + std::hypot(arc.a.z(), arc.b.z()), 2.0);
    const int order = ray_order(highest, highest < 1 ? std::sqrt(highest * (2 - highest)) : 1, 15);
    for (int j = 0; j < pieces; ++j) {
      for (const GaussNode& node : gauss_rule(around)) {
        const double angle = arc.from + half * (2 * j + 1 + node.at);
        const SphereRay ray(Vector3::Zero(), arc.at(angle), arc.rate(angle), highest < SphereRay::low);
        for (const GaussNode& along : gauss_rule(order)) {
          const auto [place, area] = ray.at((1 + along.at) / 2);
          visit(place, half * node.weight * along.weight / 2 * area);
        }
      }
    }
  }
  if (boundary.has_top) over_zone({0, 2}, {.heights = 8, .around = 12}, visit);
}

/// The part of a unit cylinder, (y, 1 − ζ) = (sin φ, cos φ) from its lowest line, 0 <= x <= length, where a depth d₀ +
/// d₁ x − d₃ ζ is positive; d₁ <= 0, d₃ >= 0.
struct Mantle {
  double length = 0;
  double depth = 0, slope = 0, drop = 0;  ///< d₀, d₁, d₃

  /// Between x₁ and x₂ in which 0 < cos φ₀ < 1, φ₀(x) = arccos(1 − (d₀ + d₁ x)/d₃) half the width.  With
  ///     x = x₁ + (x₂ − x₁)(cos φ₁ − cos φ)/(cos φ₁ − cos φ₂),   φ = φ₁ + t (φ₂ − φ₁),   0 <= t <= 1,
  /// everything is smooth in t, however the strip ends.
  struct Strip {
    double x1, x2, wide, narrow;  ///< x₁, x₂, φ₁, φ₂
    double per_cosine;            ///< (x₂ − x₁)(φ₂ − φ₁)/(cos φ₁ − cos φ₂)
    [[nodiscard]] bool empty() const { return !(x2 > x1); }
    [[nodiscard]] double half_width(double t) const { return wide + t * (narrow - wide); }
    [[nodiscard]] double x(double t) const;
    [[nodiscard]] double rate(double t) const { return per_cosine * std::sin(half_width(t)); }
  };

  [[nodiscard]] double end() const;       ///< where the depth is no more positive, or the length
  [[nodiscard]] double full_end() const;  ///< up to which all around is below the ground
  [[nodiscard]] double half_width(double x) const;
  [[nodiscard]] Strip strip() const;
};

/// By the sine of half the angle from the lowest line, which lies between −π/2 and π/2.
[[nodiscard]] inline Vector3 mantle_point_at(double x, double half_sine) {
  const double square = half_sine * half_sine;
  return {x, 2 * half_sine * std::sqrt(std::max(1 - square, 0.0)), 2 * square};
}

[[nodiscard]] inline Vector3 mantle_point(double x, double angle) { return mantle_point_at(x, std::sin(angle / 2)); }

/// Calls visit(p, area) over the part of a mantle below the ground.  `around`: points where it lies below all around;
/// `more`: nodes beside those that sines and cosines need.
void over_mantle(const Mantle& mantle, int around, int more, auto&& visit) {
  const int along = 8 + more;
  if (const double end = mantle.full_end(); end > 0) {
    for (const GaussNode& node : gauss_rule(along)) {
      for (int i = 0; i < around; ++i) {
        visit(mantle_point(end * (1 + node.at) / 2, 2 * std::numbers::pi * i / around - std::numbers::pi),
              end / 2 * node.weight * 2 * std::numbers::pi / around);
      }
    }
  }
  const Mantle::Strip strip = mantle.strip();
  if (strip.empty()) return;
  for (const GaussNode& node : gauss_rule(std::min(trigonometric_order(strip.wide / 2) + 2 + more, most_gauss_nodes))) {
    const double t = (1 + node.at) / 2, x = strip.x(t), half = strip.half_width(t);
    const auto rule = gauss_rule(std::min(trigonometric_order(half) + more, most_gauss_nodes));
    const double weight = node.weight / 2 * strip.rate(t) * half;
    for (std::size_t i = 0; 2 * i < rule.size(); ++i) {  // its nodes lie in pairs
      const double sine = std::sin(half * rule[i].at / 2), area = weight * rule[i].weight;
      visit(mantle_point_at(x, sine), area);
      if (2 * i + 1 < rule.size()) visit(mantle_point_at(x, -sine), area);
    }
  }
}

/// The part of a unit cylinder (as Mantle's) or sphere in half-spaces, by slices across an axis: circles, of which it
/// has pieces.  On sphere and cylinder dA = dx dφ, x along the axis and φ the angle on the circle from its lowest
/// point.
class Slices {
 public:
  static constexpr int most = 2 * HalfSpaces::most;
  struct Slice {
    double x = 0, rate = 0;             ///< dx over that of the parameter
    double radius = 1;                  ///< of the circle
    std::array<double, most> from, to;  ///< angles of the pieces
    int count = 0;
  };

  /// Strip of a cylinder of this length.
  Slices(double length, const HalfSpaces& half_spaces);
  /// Cap of the sphere, the axis along the ground at this angle from x.
  Slices(const HalfSpaces& half_spaces, double axis);

  /// Makes intervals end where these planes meet one another, or nearly do, and where they touch a circle.
  void mind(const SpaceLinear& one, const SpaceLinear& other);
  [[nodiscard]] int intervals() const { return count_ - 1; }
  /// Within an interval, by a parameter from 0 to 1 in which roots at both of its ends become smooth.
  [[nodiscard]] Slice slice(int interval, double part) const;
  [[nodiscard]] Vector3 place(const Slice& slice, double angle) const;
  /// Unit, along the ground and along a slice at its lowest point.
  [[nodiscard]] const Vector3& across() const { return across_; }

  /// Calls visit(slice, from, to, weight): ∫f dA = Σ weight ∫f dφ.
  void each_piece(auto&& visit) const {
    constexpr int along = 20;
    for (int i = 0; i < intervals(); ++i) {
      for (const GaussNode& node : gauss_rule(along)) {
        const Slice slice = this->slice(i, (1 + node.at) / 2);
        for (int s = 0; s < slice.count; ++s) {
          const auto piece = static_cast<std::size_t>(s);
          visit(slice, slice.from[piece], slice.to[piece], node.weight / 2 * slice.rate);
        }
      }
    }
  }
  /// Calls visit(p, area).  Right to some 1e-10.
  void visit(auto&& visit) const {
    constexpr int across = 14;
    each_piece([&](const Slice& slice, double from, double to, double weight) {
      for (const GaussNode& node : gauss_rule(across)) {
        visit(place(slice, (from + to) / 2 + (to - from) / 2 * node.at), weight * (to - from) / 2 * node.weight);
      }
    });
  }

 private:
  void begin(double low, double high);
  void add_break(double x);
  void add_touches(const SpaceLinear& plane);
  void add_corners(const SpaceLinear& one, const SpaceLinear& other);
  void add_near_miss(const SpaceLinear& one, const SpaceLinear& other);
  [[nodiscard]] double along(const Vector3& v) const { return along_.dot(v); }

  bool is_sphere_;
  Vector3 along_, across_;
  double low_ = 0, high_ = 0;
  HalfSpaces half_spaces_;
  std::array<double, 96> breaks_;
  int count_ = 0;
};

}  // namespace clatter::numeric
