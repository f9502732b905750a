// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::numeric {
namespace {

/// The least part of the energy by S₂ and S₁ that is taken: S₄ gives less of any convex body, whose √(area deeper than
/// δ) is concave by Brunn and Minkowski, so that a cone's 1.2649 is the most that √S₄ S₁/S₂^(3/2) may be.
constexpr double least_by_depths = 0.78;
constexpr double round_enough = 1e-4;      ///< det Σ over (tr Σ)² from which on any axes keep the digits
constexpr double least_roundness = 1e-26;  ///< of det Σ over (tr Σ)²: below it all is rounding

/// Complete homogeneous polynomials h₃ and h₄ of the corners' values a: means of a³ and a⁴ are h₃/10 and h₄/15, and of
/// a³b Σ bᵢ h₃(aᵢ too)/60.
struct Powers {
  double first, square, cube, fourth;
  explicit Powers(const CornerValues& a) {
    const double two = a.p + a.q, two_square = a.p * a.p + a.q * two, two_cube = a.p * a.p * a.p + a.q * two_square;
    first = two + a.r;
    square = two_square + a.r * first;
    cube = two_cube + a.r * square;
    fourth = a.p * a.p * a.p * a.p + a.q * two_cube + a.r * cube;
  }
  [[nodiscard]] double with(double a) const { return cube + a * (square + a * (first + a)); }
};

}  // namespace

AspectFactor aspect_factor(double q) {
  // With X = cosh(ln r/2): κ = agm(X, 1), and its derivative goes through the same steps.
  const double root = std::sqrt(q), start = std::sqrt((1 + root) / 2);
  double a = start, b = 1, da = 1, db = 0;
  while (std::fabs(a - b) > 1e-8 * a) {
    const double middle = (a + b) / 2, dmiddle = (da + db) / 2, product = std::sqrt(a * b);
    db = (da * b + a * db) / (2 * product);
    a = middle;
    da = dmiddle;
    b = product;
  }
  const double value = (a + b) / 2, slope = (da + db) / 2;
  return {value, slope / value * root / (8 * start)};
}

/// ∫δ, ∫δ², ∫δ⁴, ∫δx and ∫δxxᵀ.
struct Footprint::Moments {
  double depth = 0, depth_squared = 0, depth_fourth = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

void Footprint::begin(const Vector3& up) {
  up_ = up;
  // Seen from below, where facets that look down turn counter-clockwise.
  x_axis_ = up_.unitOrthogonal();
  y_axis_ = x_axis_.cross(up_);
  is_empty_ = true;
  corners_.clear();
  ends_.clear();
  nodes_.clear();
}

Footprint::Place Footprint::place_of(const Vector3& origin, const Vector3& place, double depth) {
  if (is_empty_) {
    origin_ = origin;
    rise_ = -depth - up_.dot(place);
    is_empty_ = false;
  }
  const Vector3 away = origin - origin_;
  return {x_axis_.dot(away) + x_axis_.dot(place), y_axis_.dot(away) + y_axis_.dot(place), depth};
}

void Footprint::add(const ContactPolygon& polygon) {
  for (int i = 0; i < polygon.count; ++i) {
    const ContactCorner& corner = polygon.corners[i];
    corners_.push_back(place_of(polygon.origin, corner.position, corner.depth));
  }
  ends_.push_back(corners_.size());
}

void Footprint::add(const Vector3& origin, const Vector3& place, double depth, double area) {
  nodes_.push_back({place_of(origin, place, depth), area});
}

template <class Triangle, class Point>
void Footprint::visit(Triangle&& triangle, Point&& point) const {
  std::size_t begin = 0;
  for (const std::size_t end : ends_) {
    const Place& p = corners_[begin];
    for (std::size_t i = begin + 2; i < end; ++i) {
      const Place &q = corners_[i - 1], &r = corners_[i];
      const double area = ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)) / 2;
      if (area != 0)
        triangle(area, CornerValues{p.x, q.x, r.x}, CornerValues{p.y, q.y, r.y},
                 CornerValues{p.depth, q.depth, r.depth});
    }
    begin = end;
  }
  for (const Node& node : nodes_) point(node.area, node.place);
}

Footprint::Moments Footprint::moments() const {
  Moments sums;
  visit(
      [&](double area, const CornerValues& x, const CornerValues& y, const CornerValues& depth) {
        sums.depth += area / 3 * depth.sum;
        sums.depth_squared += area * mean(depth, depth);
        sums.depth_fourth += area / 15 * Powers(depth).fourth;
        sums.x += area * mean(depth, x);
        sums.y += area * mean(depth, y);
        sums.xx += area * mean(depth, x, x);
        sums.xy += area * mean(depth, x, y);
        sums.yy += area * mean(depth, y, y);
      },
      [&](double area, const Place& at) {
        const double volume = area * at.depth;
        sums.depth += volume;
        sums.depth_squared += volume * at.depth;
        sums.depth_fourth += volume * at.depth * at.depth * at.depth;
        sums.x += volume * at.x;
        sums.y += volume * at.y;
        sums.xx += volume * at.x * at.x;
        sums.xy += volume * at.x * at.y;
        sums.yy += volume * at.y * at.y;
      });
  return sums;
}

/// New coordinates, from (x, y) on and turned.
void Footprint::turn(double x, double y, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const auto move = [&](Place& at) {
    const double dx = at.x - x, dy = at.y - y;
    at.x = cosine * dx + sine * dy;
    at.y = cosine * dy - sine * dx;
  };
  for (Place& corner : corners_) move(corner);
  for (Node& node : nodes_) move(node.place);
  origin_ += x * x_axis_ + y * y_axis_;
  const Vector3 along = x_axis_;
  x_axis_ = cosine * along + sine * y_axis_;
  y_axis_ = cosine * y_axis_ - sine * along;
}

/// ∫R over U/S₁, as it is without and with a place x; the couple of what acts along the ground is in the latter.
struct Footprint::Rest {
  double sum = 0, x = 0, y = 0;
};

/// R of the bend b = G B: by xᵀ b x, and −1 where the energy is of S₁ and S₂.
Footprint::Rest Footprint::rest_by_shape(const Bend& bend, double constant) const {
  Rest rest;
  double square_x = 0, square_y = 0;
  visit(
      [&](double area, const CornerValues& x, const CornerValues& y, const CornerValues& depth) {
        const CornerValues u{bend.xx * x.p + bend.xy * y.p, bend.xx * x.q + bend.xy * y.q,
                             bend.xx * x.r + bend.xy * y.r};
        const CornerValues v{bend.xy * x.p + bend.yy * y.p, bend.xy * x.q + bend.yy * y.q,
                             bend.xy * x.r + bend.yy * y.r};
        rest.sum += area * (mean(u, x) + mean(v, y) + constant);
        rest.x += area * (mean(u, x, x) + mean(v, y, x) + constant * x.sum / 3);
        rest.y += area * (mean(u, x, y) + mean(v, y, y) + constant * y.sum / 3);
        square_x += area * mean(depth, depth, x);
        square_y += area * mean(depth, depth, y);
      },
      [&](double area, const Place& at) {
        const double g = area * (bend.xx * at.x * at.x + 2 * bend.xy * at.x * at.y + bend.yy * at.y * at.y + constant);
        rest.sum += g;
        rest.x += g * at.x;
        rest.y += g * at.y;
        square_x += area * at.depth * at.depth * at.x;
        square_y += area * at.depth * at.depth * at.y;
      });
  rest.x -= bend.xx * square_x + bend.xy * square_y;
  rest.y -= bend.xy * square_x + bend.yy * square_y;
  return rest;
}

/// ∫δ³ and ∫δ³x.
Footprint::Rest Footprint::cubes() const {
  Rest sums;
  visit(
      [&](double area, const CornerValues& x, const CornerValues& y, const CornerValues& depth) {
        const Powers of(depth);
        const double p = of.with(depth.p), q = of.with(depth.q), r = of.with(depth.r);
        sums.sum += area / 10 * of.cube;
        sums.x += area / 60 * (p * x.p + q * x.q + r * x.r);
        sums.y += area / 60 * (p * y.p + q * y.q + r * y.r);
      },
      [&](double area, const Place& at) {
        const double cube = area * at.depth * at.depth * at.depth;
        sums.sum += cube;
        sums.x += cube * at.x;
        sums.y += cube * at.y;
      });
  return sums;
}

/// From c on.  What is long is seen along its axes, where a cross moment does not swallow the digits of the short one.
Footprint::Moments Footprint::centred() {
  Moments sums = moments();
  const double s1 = sums.depth, x = sums.x / s1, y = sums.y / s1;
  sums.xx -= x * sums.x;
  sums.xy -= x * sums.y;
  sums.yy -= y * sums.y;
  sums.x = sums.y = 0;
  const double trace = sums.xx + sums.yy;
  const bool is_round = sums.xx * sums.yy - sums.xy * sums.xy > round_enough * trace * trace;
  turn(x, y, is_round ? 0 : std::atan2(2 * sums.xy, sums.xx - sums.yy) / 2);
  return is_round ? sums : moments();
}

HalfSpacePressure Footprint::pressure(double modulus) {
  HalfSpacePressure found;
  if (is_empty_) return found;
  const Moments sums = centred();
  const double s1 = sums.depth, s2 = sums.depth_squared;
  if (!(s1 > 0 && s2 > 0)) return found;
  const double xx = sums.xx / s1, xy = sums.xy / s1, yy = sums.yy / s1, trace = xx + yy;
  const double determinant = std::max(xx * yy - xy * xy, least_roundness * trace * trace);
  const AspectFactor factor = aspect_factor(trace * trace / (4 * determinant));
  const double by_squares = s2 * std::sqrt(s2) / s1, by_depths = least_by_depths * std::sqrt(sums.depth_fourth);
  const bool is_stepped = by_depths > by_squares;
  found.energy = modulus * std::numbers::inv_sqrtpi * factor.value * std::max(by_squares, by_depths);
  found.stiffness = 3 * found.energy / s2;
  found.volume = s1;
  found.extent = std::sqrt(trace);

  const double g = factor.exponent;
  Rest rest =
      rest_by_shape({g * (2 / trace - yy / determinant), g * xy / determinant, g * (2 / trace - xx / determinant)},
                    is_stepped ? 0 : -1);
  if (is_stepped) {  // 2δ³/S₄ − 3δ/S₂ in place of −1/S₁
    const Rest cube = cubes();
    const double by_cube = 2 * s1 / sums.depth_fourth, by_depth = 3 * s1 / s2;
    rest.sum += by_cube * cube.sum - by_depth * s1;
    rest.x += by_cube * cube.x - by_depth * sums.x;
    rest.y += by_cube * cube.y - by_depth * sums.y;
  }
  const double per_volume = found.energy / s1;
  // The surface lies δ below the ground, and ∫Rδ = −U, since U is of degree 2 in δ.
  const double square = up_.squaredNorm();
  found.rest = per_volume * rest.sum;
  found.rest_moment = found.rest * origin_ + per_volume * (rest.x * x_axis_ + rest.y * y_axis_) +
                      (found.energy - rise_ * found.rest) / square * up_;
  found.volume_moment = s1 * origin_ + sums.x * x_axis_ + sums.y * y_axis_ - (s2 + rise_ * s1) / square * up_;
  return found;
}

}  // namespace clatter::numeric
