// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_polygon.hpp"

namespace clatter::numeric {
namespace {

/// Corners of a triangle of the fan.
struct Triangle {
  const ContactCorner& p;
  const ContactCorner& q;
  const ContactCorner& r;
};

void for_each_triangle(const ContactPolygon& polygon, auto&& use) {
  const ContactCorner* corners = polygon.corners;
  for (int i = 2; i < polygon.count; ++i) {
    const Triangle t{corners[0], corners[i - 1], corners[i]};
    const Vector3 along = t.q.position - t.p.position;
    const double area = 0.5 * polygon.normal.dot(along.cross(t.r.position - t.p.position));
    if (area != 0) use(t, area);
  }
}

CornerValues depths(const Triangle& t) { return {t.p.depth, t.q.depth, t.r.depth}; }
CornerValues rates(const Triangle& t) { return {t.p.rate, t.q.rate, t.r.rate}; }

Vector3 weighted(const CornerValues& a, const Triangle& t) {
  return a.p * t.p.position + a.q * t.q.position + a.r * t.r.position;
}

/// ∫ab² over the area.
double integral_of_square(const CornerValues& a, const CornerValues& b) {
  const CornerValues ab = products(a, b);
  return (a.sum * b.sum * b.sum + a.sum * products(b, b).sum + 2 * b.sum * ab.sum + 2 * products(ab, b).sum) / 60;
}

Vector3 moment(const CornerValues& a, const Triangle& t, const Vector3& position_sum) {
  return (a.sum * position_sum + weighted(a, t)) / 12;
}

Vector3 moment(const CornerValues& a, const CornerValues& b, const Triangle& t, const Vector3& position_sum) {
  const CornerValues ab = products(a, b);
  return ((a.sum * b.sum + ab.sum) * position_sum + a.sum * weighted(b, t) + b.sum * weighted(a, t) +
          2 * weighted(ab, t)) /
         60;
}

}  // namespace

void LoadIntegrals::add(const LoadIntegrals& other, double weight) {
  depth += weight * other.depth;
  depth_rate += weight * other.depth_rate;
  depth_squared += weight * other.depth_squared;
  depth_rate_squared += weight * other.depth_rate_squared;
  depth_position += weight * other.depth_position;
  depth_rate_position += weight * other.depth_rate_position;
}

void RateIntegrals::add(const RateIntegrals& other, double weight) {
  rate += weight * other.rate;
  rate_squared += weight * other.rate_squared;
  rate_position += weight * other.rate_position;
  rate_squared_position += weight * other.rate_squared_position;
  depth_position_squared += weight * other.depth_position_squared;
}

LoadIntegrals load_integrals(const ContactPolygon& polygon) {
  LoadIntegrals sums;
  for_each_triangle(polygon, [&](const Triangle& t, double area) {
    const CornerValues depth = depths(t), rate = rates(t);
    const Vector3 positions = t.p.position + t.q.position + t.r.position;
    sums.depth += area * depth.sum / 3;
    sums.depth_rate += area * mean(depth, rate);
    sums.depth_squared += area * mean(depth, depth);
    sums.depth_rate_squared += area * integral_of_square(depth, rate);
    sums.depth_position += area * moment(depth, t, positions);
    sums.depth_rate_position += area * moment(depth, rate, t, positions);
  });
  sums.depth_position += sums.depth * polygon.origin;
  sums.depth_rate_position += sums.depth_rate * polygon.origin;
  return sums;
}

RateIntegrals rate_integrals(const ContactPolygon& polygon) {
  RateIntegrals sums;
  double depth_sum = 0;
  Vector3 depth_position = Vector3::Zero();
  for_each_triangle(polygon, [&](const Triangle& t, double area) {
    const CornerValues depth = depths(t), rate = rates(t);
    const Vector3 positions = t.p.position + t.q.position + t.r.position;
    sums.rate += area * rate.sum / 3;
    sums.rate_squared += area * mean(rate, rate);
    sums.rate_position += area * moment(rate, t, positions);
    sums.rate_squared_position += area * moment(rate, rate, t, positions);
    depth_sum += area * depth.sum / 3;
    depth_position += area * moment(depth, t, positions);
    const auto outer = [&](const ContactCorner& corner) {
      return (depth.sum + 2 * corner.depth) * (corner.position * corner.position.transpose());
    };
    const Matrix3 mixed = weighted(depth, t) * positions.transpose();
    sums.depth_position_squared += area / 60 *
                                   (depth.sum * (positions * positions.transpose()) + mixed + mixed.transpose() +
                                    outer(t.p) + outer(t.q) + outer(t.r));
  });
  const Matrix3 shift = polygon.origin * depth_position.transpose();
  sums.rate_position += sums.rate * polygon.origin;
  sums.rate_squared_position += sums.rate_squared * polygon.origin;
  sums.depth_position_squared += shift + shift.transpose() + depth_sum * (polygon.origin * polygon.origin.transpose());
  return sums;
}

DepthIntegrals depth_integrals(const ContactPolygon& polygon) {
  DepthIntegrals sums;
  for_each_triangle(polygon, [&](const Triangle& t, double area) {
    const CornerValues depth = depths(t);
    sums.depth_squared += area * mean(depth, depth);
    sums.depth_rate += area * mean(depth, rates(t));
  });
  return sums;
}

}  // namespace clatter::numeric
