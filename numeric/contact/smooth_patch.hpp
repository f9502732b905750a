// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature over the parts of a unit ball and of a unit cylinder that lie below the ground.
#pragma once

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
  void add(const SpaceLinear& positive) { all_[static_cast<std::size_t>(count_++)] = positive; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const SpaceLinear& operator[](int i) const { return all_[static_cast<std::size_t>(i)]; }
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

/// Where the curves from a point of the sphere to a point of its boundary lie, and what area they sweep: along the
/// great circle from c to b, φ = the angle between them,
///     p(λ) = [sin((1 − λ)φ) c + sin(λφ) b]/sin φ,   dA = (sin λφ/sin φ)(φ/sin φ) |c, b, db| dλ,        seen from the
///     centre.
class SphereRay {
 public:
  /// @param rate  of `end` along the boundary, which has the part on its left
  SphereRay(const Vector3& from, const Vector3& end, const Vector3& rate) : from_(from), end_(end) {
    const Vector3 way = end - from;
    half_ = std::asin(std::min(way.norm() / 2, 1.0));
    const double sine = std::sin(2 * half_);
    inverse_sine_ = sine > 0 ? 1 / sine : 0;
    area_ = -(from - Vector3::UnitZ()).dot(way.cross(rate)) * (sine > 0 ? 2 * half_ * inverse_sine_ : 1);
  }
  /// Half the angle [rad].
  [[nodiscard]] double half_angle() const { return half_; }
  [[nodiscard]] double area(double part) const { return area_ * towards_end(part); }
  [[nodiscard]] Vector3 at(double part) const {
    Vector3 p = towards_end(1 - part) * from_ + towards_end(part) * end_;
    p.z() -= 2 * std::sin(part * half_) * std::sin((1 - part) * half_) / std::cos(half_);
    return p;
  }

 private:
  [[nodiscard]] double towards_end(double part) const {
    return inverse_sine_ > 0 ? std::sin(2 * part * half_) * inverse_sine_ : part;
  }
  Vector3 from_, end_;
  double half_ = 0, inverse_sine_ = 0, area_ = 0;
};

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
template <class Visit>
void over_zone(const Zone& zone, const CapRule& rule, Visit&& visit) {
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
  return half_angle < 0.05 ? 5 : half_angle < 0.2 ? 7 : half_angle < 0.6 ? 10 : half_angle < 1.2 ? 14 : 20;
}

/// The same over the part of the sphere in half-spaces: the fans between its lowest point and the arcs of the boundary,
/// whose areas have signs, so that it matters not where that point lies.  Exact to rounding for polynomials of low
/// degree.
template <class Visit>
void over_part(const HalfSpaces& half_spaces, Visit&& visit) {
  constexpr double piece = std::numbers::pi, small_piece = 1;
  const SphereBoundary boundary(half_spaces);
  for (int i = 0; i < boundary.count; ++i) {
    const SphereArc& arc = boundary.arcs[static_cast<std::size_t>(i)];
    const int pieces = std::max(1, static_cast<int>(std::ceil((arc.to - arc.from) / piece)));
    const int around = arc.to - arc.from < small_piece ? 10 : 16;
    const double half = (arc.to - arc.from) / (2 * pieces);
    for (int j = 0; j < pieces; ++j) {
      for (const GaussNode& node : gauss_rule(around)) {
        const double angle = arc.from + half * (2 * j + 1 + node.at);
        const SphereRay ray(Vector3::Zero(), arc.at(angle), arc.rate(angle));
        for (const GaussNode& along : gauss_rule(trigonometric_order(ray.half_angle()))) {
          const double part = (1 + along.at) / 2;
          visit(ray.at(part), half * node.weight * along.weight / 2 * ray.area(part));
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
    [[nodiscard]] bool empty() const { return !(x2 > x1); }
    [[nodiscard]] double half_width(double t) const { return wide + t * (narrow - wide); }
    [[nodiscard]] double x(double t) const { return x1 + (x2 - x1) * share(t); }
    [[nodiscard]] double rate(double t) const;

   private:
    [[nodiscard]] double share(double t) const;
  };

  [[nodiscard]] double end() const;       ///< where the depth is no more positive, or the length
  [[nodiscard]] double full_end() const;  ///< up to which all around is below the ground
  [[nodiscard]] double half_width(double x) const;
  [[nodiscard]] Strip strip() const;
};

[[nodiscard]] inline Vector3 mantle_point(double x, double angle) {
  const double half = std::sin(angle / 2);
  return {x, std::sin(angle), 2 * half * half};
}

/// Calls visit(p, area) over the part of a mantle below the ground.  `around`: points where it lies below all around;
/// `more`: nodes beside those that sines and cosines need.
template <class Visit>
void over_mantle(const Mantle& mantle, int around, int more, Visit&& visit) {
  const int along = 8 + more;
  if (const double end = mantle.full_end(); end > 0) {
    for (const GaussNode& node : gauss_rule(along)) {
      for (int i = 0; i < around; ++i) {
        visit(mantle_point(end * (1 + node.at) / 2, 2 * std::numbers::pi * i / around),
              end / 2 * node.weight * 2 * std::numbers::pi / around);
      }
    }
  }
  const Mantle::Strip strip = mantle.strip();
  if (strip.empty()) return;
  for (const GaussNode& node : gauss_rule(std::min(trigonometric_order(strip.wide / 2) + 2 + more, most_gauss_nodes))) {
    const double t = (1 + node.at) / 2, x = strip.x(t), half = strip.half_width(t);
    for (const GaussNode& across : gauss_rule(std::min(trigonometric_order(half) + more, most_gauss_nodes))) {
      visit(mantle_point(x, half * across.at), node.weight / 2 * strip.rate(t) * half * across.weight);
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

  /// Makes intervals end where these planes meet one another and where they touch a circle.
  void mind(const SpaceLinear& one, const SpaceLinear& other);
  [[nodiscard]] int intervals() const { return count_ - 1; }
  /// Within an interval, by a parameter from 0 to 1 in which roots at both of its ends become smooth.
  [[nodiscard]] Slice slice(int interval, double part) const;
  [[nodiscard]] Vector3 place(const Slice& slice, double angle) const;

  /// Calls visit(slice, from, to, weight): ∫f dA = Σ weight ∫f dφ.
  template <class Visit>
  void each_piece(Visit&& visit) const {
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
  template <class Visit>
  void visit(Visit&& visit) const {
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
  [[nodiscard]] double along(const Vector3& v) const { return along_.dot(v); }

  bool is_sphere_;
  Vector3 along_, across_;
  double low_ = 0, high_ = 0;
  HalfSpaces half_spaces_;
  std::array<double, 96> breaks_;
  int count_ = 0;
};

}  // namespace clatter::numeric
