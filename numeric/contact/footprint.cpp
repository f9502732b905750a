// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numeric/contact/contact_load.hpp"

namespace clatter::numeric {
namespace {

constexpr double least_roundness = 1e-26;  ///< of det Σ over (tr Σ)²: below it all is rounding

/// CornerValues of a linear function at the corners of a triangle, with their sum.
struct CornerValues {
  double p, q, r;
  double sum = p + q + r;
};

CornerValues products(const CornerValues& a, const CornerValues& b) { return {a.p * b.p, a.q * b.q, a.r * b.r}; }

/// Means over the triangle: ∫ab and ∫abc over its area.
double mean(const CornerValues& a, const CornerValues& b) { return (a.sum * b.sum + products(a, b).sum) / 12; }
double mean(const CornerValues& a, const CornerValues& b, const CornerValues& c) {
  const CornerValues bc = products(b, c);
  return (a.sum * b.sum * c.sum + a.sum * bc.sum + b.sum * products(a, c).sum + c.sum * products(a, b).sum +
          2 * products(a, bc).sum) /
         60;
}

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

/// ∫δ, ∫δ², ∫δx and ∫δxxᵀ.
struct Footprint::Moments {
  double depth = 0, depth_squared = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

void Footprint::begin(const GroundView& view) {
  view_ = &view;
  up_ = view.normal();
  // Seen from below, where facets that look down turn counter-clockwise.
  x_axis_ = up_.unitOrthogonal();
  y_axis_ = x_axis_.cross(up_);
  is_empty_ = true;
  corners_.clear();
  ends_.clear();
  nodes_.clear();
}

Footprint::Place Footprint::place_of(const Vector3& origin, const Vector3& place, double depth) {
  if (is_empty_) origin_ = origin;
  is_empty_ = false;
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

HalfSpacePressure Footprint::pressure(double modulus) {
  HalfSpacePressure found;
  const Moments first = moments();
  const double s1 = first.depth, s2 = first.depth_squared;
  if (!(s1 > 0 && s2 > 0)) return found;
  const double cx = first.x / s1, cy = first.y / s1;
  turn(cx, cy, std::atan2(2 * (first.xy / s1 - cx * cy), first.xx / s1 - cx * cx - (first.yy / s1 - cy * cy)) / 2);
  const Moments by_axes = moments();
  const double xx = by_axes.xx / s1, xy = by_axes.xy / s1, yy = by_axes.yy / s1, trace = xx + yy;
  const double determinant = std::max(xx * yy - xy * xy, least_roundness * trace * trace);
  const AspectFactor factor = aspect_factor(trace * trace / (4 * determinant));
  found.energy = modulus * std::numbers::inv_sqrtpi * s2 * std::sqrt(s2) / s1 * factor.value;
  found.stiffness = 3 * found.energy / s2;
  found.volume = s1;
  found.extent = std::sqrt(trace);

  // ∫g, ∫gx and ∫gy of g = −1 + G xᵀBx; ∫δ²x and ∫δ²y.
  const double bend = factor.exponent;
  const double bxx = bend * (2 / trace - yy / determinant), byy = bend * (2 / trace - xx / determinant),
               bxy = bend * xy / determinant;
  double sum = 0, sum_x = 0, sum_y = 0, square_x = 0, square_y = 0;
  visit(
      [&](double area, const CornerValues& x, const CornerValues& y, const CornerValues& depth) {
        const CornerValues u{bxx * x.p + bxy * y.p, bxx * x.q + bxy * y.q, bxx * x.r + bxy * y.r};
        const CornerValues v{bxy * x.p + byy * y.p, bxy * x.q + byy * y.q, bxy * x.r + byy * y.r};
        sum += area * (mean(u, x) + mean(v, y) - 1);
        sum_x += area * (mean(u, x, x) + mean(v, y, x) - x.sum / 3);
        sum_y += area * (mean(u, x, y) + mean(v, y, y) - y.sum / 3);
        square_x += area * mean(depth, depth, x);
        square_y += area * mean(depth, depth, y);
      },
      [&](double area, const Place& at) {
        const double g = area * (bxx * at.x * at.x + 2 * bxy * at.x * at.y + byy * at.y * at.y - 1);
        sum += g;
        sum_x += g * at.x;
        sum_y += g * at.y;
        square_x += area * at.depth * at.depth * at.x;
        square_y += area * at.depth * at.depth * at.y;
      });
  sum_x -= bxx * square_x + bxy * square_y;
  sum_y -= bxy * square_x + byy * square_y;
  const double per_volume = found.energy / s1;
  // The surface lies δ below the ground, and ∫Rδ = −U, since U is of degree 2 in δ.
  const double rise = view_->height(origin_), square = up_.squaredNorm();
  found.rest = per_volume * sum;
  found.rest_moment = found.rest * origin_ + per_volume * (sum_x * x_axis_ + sum_y * y_axis_) +
                      (found.energy - rise * found.rest) / square * up_;
  found.volume_moment = s1 * origin_ + by_axes.x * x_axis_ + by_axes.y * y_axis_ - (s2 + rise * s1) / square * up_;
  return found;
}

}  // namespace clatter::numeric
