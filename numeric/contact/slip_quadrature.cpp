#include "numeric/contact/slip_quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace clatter::numeric {
namespace {

struct Point {
  double p, q, r;  ///< barycentric
  double weight;
};

/// Radon's rule: centroid and two orbits of three.
std::array<Point, 7> radon_rule() {
  const double root = std::sqrt(15.0);
  const double a = (6 - root) / 21, b = (6 + root) / 21;
  const double wa = (155 - root) / 1200, wb = (155 + root) / 1200;
  const double third = 1.0 / 3;
  return {{{third, third, third, 9.0 / 40},
           {a, a, 1 - 2 * a, wa}, {a, 1 - 2 * a, a, wa}, {1 - 2 * a, a, a, wa},
           {b, b, 1 - 2 * b, wb}, {b, 1 - 2 * b, b, wb}, {1 - 2 * b, b, b, wb}}};
}

struct Slip {
  double east, north;
};

Slip slip_at(const Vector3& u, const GroundView& view, const SlipField& field) {
  if (field.kind == SlipField::Kind::turning) {
    const Vector3 away = u - field.centre;
    return {field.east - field.spin * view.north.dot(away), field.north + field.spin * view.east.dot(away)};
  }
  const Vector3 turning = view.angular_velocity.cross(u);
  return {view.east_speed + view.east.dot(turning), view.north_speed + view.north.dot(turning)};
}

/// Where the patch turns about a point inside it, the direction jumps from one quadrature point to the next, and the
/// sum with it although the integral is smooth.  A tenth of the speed across the triangle rounds the jump off;
/// it fades with the cube of that speed over the slip of the centre.
double rounding_speed(const SlipField& field, const ContactCorner& p, const ContactCorner& q, const ContactCorner& r) {
  if (field.kind == SlipField::Kind::regularised) return field.regularisation;
  const double size = std::sqrt(std::max({(q.position - p.position).squaredNorm(), (r.position - p.position).squaredNorm(),
                                          (r.position - q.position).squaredNorm()}));
  const double across = std::fabs(field.spin) * size;
  if (!(across > 0)) return 0;
  return 0.1 * across / (1 + (field.east * field.east + field.north * field.north) / (across * across));
}

void add_point(const Vector3& u, double force, double rounding, const GroundView& view, const SlipField& field,
               ContactLoad& load) {
  const Slip slip = slip_at(u, view, field);
  const double speed = std::hypot(slip.east, slip.north, rounding);
  if (!(speed > 0)) return;
  const double at_east = -force * slip.east / speed, at_north = -force * slip.north / speed;
  load.slip_east += at_east;
  load.slip_north += at_north;
  load.slip_moment += u.cross(at_east * view.east + at_north * view.north);
}

}  // namespace

void add_slip(const ContactPolygon& polygon, double weight, const GroundView& view, const Ground& ground,
              const SlipField& slip, ContactLoad& load) {
  static const std::array<Point, 7> rule = radon_rule();
  const ContactCorner* c = polygon.corners;
  for (int i = 2; i < polygon.count; ++i) {
    const ContactCorner &p = c[0], &q = c[i - 1], &r = c[i];
    const Vector3 along = q.position - p.position;
    const double area = weight * 0.5 * polygon.normal.dot(along.cross(r.position - p.position));
    const double rounding = rounding_speed(slip, p, q, r);
    for (const Point& at : rule) {
      const double depth = at.p * p.depth + at.q * q.depth + at.r * r.depth;
      const double rate = at.p * p.rate + at.q * q.rate + at.r * r.rate;
      const Vector3 u = polygon.origin + at.p * p.position + at.q * q.position + at.r * r.position;
      const double pressure = (ground.stiffness + ground.damping * rate) * depth;
      add_point(u, area * at.weight * pressure, rounding, view, slip, load);
    }
  }
}

}  // namespace clatter::numeric
