// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/atlas/flat_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analytic/base/errors.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using analytic::near_flat::Footprint;
using analytic::near_flat::TwoContacts;
using analytic::space::Vector3;

constexpr double in_face = 1e-7;  // of the reach: corners of a file have seven digits

/// Corners turned by the attitude, the lowest first.
std::vector<Vector3> turned_corners(const analytic::space::Body& body, const analytic::space::Quaternion& attitude) {
  if (!body.rims.empty()) throw analytic::OutsideModelError("a round end lands on a rim, which has no corners");
  std::vector<Vector3> corners;
  for (const Vector3& vertex : body.vertices) corners.push_back(attitude * vertex);
  const auto lowest =
      std::ranges::min_element(corners, [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  if (corners.size() < 3) throw analytic::OutsideModelError("the body has no face to land on");
  std::iter_swap(corners.begin(), lowest);
  return corners;
}

/// Upward normal of the plane through the lowest corner that comes down first, and then about the edge.
Vector3 landing_normal(const std::vector<Vector3>& corners, double reach) {
  const Vector3& pivot = corners.front();
  const auto slope = [&](const Vector3& p) {
    const double run = (p - pivot).head<2>().norm();
    return run > in_face * reach ? (p - pivot).z() / run : INFINITY;
  };
  const auto second = std::min_element(corners.begin() + 1, corners.end(),
                                       [&](const Vector3& a, const Vector3& b) { return slope(a) < slope(b); });
  const Vector3 edge = (*second - pivot).normalized();
  const Vector3 across = Vector3::UnitZ().cross(edge).normalized(), up = edge.cross(across);
  double least = INFINITY;
  Vector3 normal = up;
  for (const Vector3& p : corners) {
    const double run = (p - pivot).dot(across), rise = (p - pivot).dot(up);
    if (!(std::fabs(run) > in_face * reach) || !(rise / std::fabs(run) < least)) continue;
    least = rise / std::fabs(run);
    normal = (run * up - rise * across).normalized() * (run > 0 ? 1 : -1);
  }
  if (!std::isfinite(least)) throw analytic::OutsideModelError("the body has no face to land on");
  return normal;
}

TwoContacts landing_contacts(const analytic::PlanarBody& body, const analytic::Angle& inclination) {
  std::vector<analytic::ContactPoint> points;
  for (int i = 0; i < body.vertex_count; ++i) {
    points.push_back(body.contact_point(i, inclination.sine, inclination.cosine));
  }
  std::ranges::sort(points, {}, &analytic::ContactPoint::normal);
  const analytic::ContactPoint low = points.front();
  const auto slope = [&](const analytic::ContactPoint& p) {
    return std::atan2(p.normal - low.normal, std::fabs(p.tangential - low.tangential));
  };
  const analytic::ContactPoint other = *std::min_element(
      points.begin() + 1, points.end(), [&](const auto& a, const auto& b) { return slope(a) < slope(b); });
  const double x = other.tangential - low.tangential, z = other.normal - low.normal;
  const double length = std::hypot(x, z), sign = x < 0 ? -1 : 1;
  const double place = sign * (low.tangential * x + low.normal * z) / length;
  const double left = std::min(place, place + sign * length);
  return {-left, left + length, std::sqrt(body.gyration_square)};
}

}  // namespace

Footprint landing_face(const analytic::space::Body& body, const analytic::space::Quaternion& attitude) {
  const std::vector<Vector3> corners = turned_corners(body, attitude);
  const double reach = body.reach();
  const Vector3 normal = landing_normal(corners, reach);
  analytic::space::Matrix3 frame;  // columns: axes of the footprint
  Vector3 x = attitude * Vector3::UnitX();
  if (std::fabs(x.dot(normal)) > 0.99) x = attitude * Vector3::UnitY();
  frame.col(0) = (x - x.dot(normal) * normal).normalized();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  Footprint found;
  for (const Vector3& corner : corners) {
    if (std::fabs((corner - corners.front()).dot(normal)) > in_face * reach) continue;
    found.corners.emplace_back(frame.col(0).dot(corner), frame.col(1).dot(corner));
  }
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const auto& corner : found.corners) middle += corner / static_cast<double>(found.corners.size());
  std::ranges::sort(found.corners, {}, [&](const Eigen::Vector2d& r) {
    const double angle = std::atan2(r.y() - middle.y(), r.x() - middle.x());
    return angle < -3.14159265 ? -angle : angle;  // −π is π
  });
  const analytic::space::Matrix3 turn = frame.transpose() * attitude.toRotationMatrix();
  found.mobility = analytic::near_flat::slope_mobility(body.mass, turn * body.inertia * turn.transpose());
  found.mobility = ((found.mobility + found.mobility.transpose()) / 2).eval();
  return found;
}

FlatBody flat_body(const Scene& scene, bool in_plane) {
  const analytic::ImpactLaw law = discrete_law(scene).law;
  if (law.law == analytic::RestitutionLaw::viscoelastic) {
    throw analytic::OutsideModelError(
        "close to flat strikes have one restitution, and damped ground has another for each speed: give --restitution");
  }
  DiscreteBody body(scene);
  FlatBody found{.contacts = TwoContacts(), .words = "", .restitution = law.restitution};
  if (in_plane || scene.body.shape == BodyScene::Shape::rod) {
    const auto& outline = body.outline();
    if (!outline) throw analytic::OutsideModelError("the body has no outline in the plane y = 0");
    const TwoContacts two = landing_contacts(*outline, analytic::Angle::from_degrees(scene.angle_deg));
    found.words = fmt::format("two contacts, a = {} m and b = {} m from the centre of mass, radius of gyration {} m",
                              significant(two.arm_a, 6), significant(two.arm_b, 6), significant(two.gyration, 6));
    found.contacts = two;
    return found;
  }
  const Footprint face = landing_face(body.in_space(), scene.touch_attitude());
  found.words = fmt::format("face of {} corners [m]:", face.corners.size());
  for (std::size_t i = 0; i < face.corners.size() && i < 12; ++i) {
    found.words += fmt::format("{} {} ({}, {})", i == 0 ? "" : ",", i + 1, significant(face.corners[i].x(), 4),
                               significant(face.corners[i].y(), 4));
  }
  found.contacts = face;
  return found;
}

FlatBody flat_triangle(double restitution) {
  analytic::space::Matrix3 inertia = analytic::space::Matrix3::Zero();
  inertia.diagonal() << 1. / 18, 1. / 18, 1. / 9;  // of the right triangle with legs 1, mass 1
  inertia(0, 1) = inertia(1, 0) = 1. / 36;
  return {.contacts = Footprint{.corners = {{-1. / 3, -1. / 3}, {2. / 3, -1. / 3}, {-1. / 3, 2. / 3}},
                                .mobility = analytic::near_flat::slope_mobility(1, inertia)},
          .words = "thin uniform triangle of any form, corners 1 to 3",
          .restitution = restitution};
}

}  // namespace clatter::validation
