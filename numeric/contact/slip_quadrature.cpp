// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/slip_quadrature.hpp"

#include <cmath>

namespace clatter::numeric {
namespace {

/// Slip velocity of the body's points: `value` at the origin, and its rates of change over the body, per metre.
struct BodySlip {
  double east = 0, north = 0;
  Vector3 east_slope, north_slope;
};

BodySlip body_slip(const Vector3& origin, const GroundView& view, const SlipField& field) {
  if (field.kind == SlipField::Kind::turning) {
    const Vector3 away = origin - field.centre;
    const Vector3 east_slope = -field.spin * view.north, north_slope = field.spin * view.east;
    return {field.east + east_slope.dot(away), field.north + north_slope.dot(away), east_slope, north_slope};
  }
  // a·(ω × u) = (a × ω)·u
  const Vector3 east_slope = view.east.cross(view.angular_velocity),
                north_slope = view.north.cross(view.angular_velocity);
  return {view.east_speed + field.east + east_slope.dot(origin),
          view.north_speed + field.north + north_slope.dot(origin), east_slope, north_slope};
}

void add_force(double east, const Vector3& east_moment, double weight, const Vector3& direction, double& sum,
               ContactLoad& load) {
  sum -= weight * east;
  load.slip_moment -= weight * east_moment.cross(direction);
}

/// One direction of slip: the part of the polygon that slips forward, less the part that slips back.
void add_split(const ContactPolygon& polygon, double weight, const GroundView& view, const Ground& ground,
               const BodySlip& slip, SlipScratch& scratch, ContactLoad& load) {
  ContactPolygon part = polygon;
  part.corners = scratch.part.data();
  for (const double side : {1.0, -1.0}) {
    part.count = clip(polygon.corners, polygon.count, scratch.part.data(), [&](const ContactCorner& corner) {
      return side * (slip.east + slip.east_slope.dot(corner.position));
    });
    if (part.count < 3) continue;
    const LoadIntegrals here = load_integrals(part);
    const double k = ground.stiffness, c = ground.damping;
    add_force(k * here.depth + c * here.depth_rate, k * here.depth_position + c * here.depth_rate_position,
              side * weight, view.east, load.slip_east, load);
  }
}

/// Widens the load's range of slip by the polygon's, which is returned.
SlipRange widen(const BodySlip& slip, const ContactPolygon& polygon, bool planar, ContactLoad& load) {
  SlipRange range;
  for (int i = 0; i < polygon.count; ++i) {
    const Vector3& u = polygon.corners[i].position;
    const double east = slip.east + slip.east_slope.dot(u), north = planar ? 0 : slip.north + slip.north_slope.dot(u);
    range.add(east, north);
    load.slip_range.add(east, north);
  }
  return range;
}

}  // namespace

void add_slip(const ContactPolygon& polygon, double weight, const GroundView& view, const Ground& ground,
              const SlipField& field, SlipScratch& scratch, ContactLoad& load) {
  const BodySlip slip = body_slip(polygon.origin, view, field);
  const SlipRange range = widen(slip, polygon, field.planar, load);
  const double rounding = range.width() > SlipField::alike * field.floor ? field.regularisation
                                                                         : std::max(field.regularisation, field.floor);
  if (field.planar && rounding == 0) return add_split(polygon, weight, view, ground, slip, scratch, load);
  const Vector3 along = polygon.normal.unitOrthogonal(), across = polygon.normal.cross(along);
  for (int i = 0; i < polygon.count; ++i) {
    const Vector3& u = polygon.corners[i].position;
    scratch.corners[static_cast<std::size_t>(i)] = {along.dot(u), across.dot(u)};
  }
  const auto over_plane = [&](double value, const Vector3& slope) {
    return PlaneLinear{value, slope.dot(along), slope.dot(across)};
  };
  const Vector3 normal = view.normal(), rate_slope = normal.cross(view.angular_velocity);
  const double rate = -(view.vertical_speed + rate_slope.dot(polygon.origin));
  SlipPatch patch{scratch.corners.data(),
                  polygon.count,
                  over_plane(-view.height(polygon.origin), -normal),
                  over_plane(ground.stiffness + ground.damping * rate, -ground.damping * rate_slope),
                  over_plane(slip.east, slip.east_slope),
                  over_plane(slip.north, slip.north_slope),
                  rounding};
  if (field.planar) patch.north = {};
  const SlipIntegrals sums = field.rough ? rough_slip_integrals(patch) : slip_integrals(patch);
  const auto moment = [&](double value, double x, double y) -> Vector3 {
    return value * polygon.origin + x * along + y * across;
  };
  add_force(sums.east, moment(sums.east, sums.east_x, sums.east_y), weight, view.east, load.slip_east, load);
  add_force(sums.north, moment(sums.north, sums.north_x, sums.north_y), weight, view.north, load.slip_north, load);
}

}  // namespace clatter::numeric
