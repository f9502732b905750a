// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that several tests drop.
#pragma once

#include <cmath>
#include <numbers>

#include "numeric/body/body.hpp"
#include "numeric/contact/contact_load.hpp"
#include "numeric/mesh/generators.hpp"
#include "numeric/simulate.hpp"

namespace clatter::numeric::test {

inline constexpr double degree = std::numbers::pi / 180;

inline Body box_body(const Vector3& size, double mass, int nx = 1, int ny = 1, int nz = 1, bool merge = true) {
  return Body(box_mesh({.size = size, .mass = mass, .nx = nx, .ny = ny, .nz = nz}), merge);
}

/// The paper's phone.
inline constexpr double phone_mass = 0.08814;
inline Vector3 phone_size() { return {0.10566, 0.04394, 0.01905}; }
inline Body phone(int nx = 1, int ny = 1, int nz = 1, bool merge = true) {
  return box_body(phone_size(), phone_mass, nx, ny, nz, merge);
}

/// The paper's rod.
inline Body rod() { return Body(rod_mesh({})); }

/// A body of this shape, its facets few, with the mass properties given.
inline Body round_body(const SmoothShape& shape, double mass, const Matrix3& inertia) {
  const Mesh mesh = round_mesh({.semiaxes = shape.semiaxes, .straight = shape.straight, .sectors = 8, .rings = 2});
  return {{.mass = mass, .centre = -shape.centre, .inertia = inertia},
          boundary_surface(mesh),
          true,
          SmoothShape{shape.semiaxes, shape.straight, Vector3::Zero()}};
}

/// The same with the inertia of a ball of this size.
inline Body round_body(const SmoothShape& shape, double mass = 1) {
  return round_body(shape, mass, 0.4 * mass * shape.semiaxes.squaredNorm() / 3 * Matrix3::Identity());
}

/// At rest, `depth` below the attitude at which the body touches; the ground's normal in the body frame.
inline GroundView pressed(const Body& body, const Vector3& normal, double depth) {
  double low = std::numeric_limits<double>::infinity();
  if (const auto& smooth = body.smooth()) {
    for (int end = 0; end < smooth->ends(); ++end) low = std::min(low, normal.dot(smooth->lowest(end, normal)));
  } else {
    for (const Vector3& u : body.facets().vertices) low = std::min(low, normal.dot(u));
  }
  GroundView view;
  view.reference = {normal, -low};
  view.sink = -depth;
  view.east = normal.unitOrthogonal();
  view.north = normal.cross(view.east);
  return view;
}

/// The ground as a body at rest sees it that was pushed `depth` below the attitude at which it touches.
inline GroundView pressed(const MotionState& touch, double depth) {
  const Eigen::Quaterniond back = touch.attitude.conjugate();
  GroundView view;
  view.reference = {back * Vector3::UnitZ(), touch.centre.z()};
  view.sink = -depth;
  view.east = back * Vector3::UnitX();
  view.north = back * Vector3::UnitY();
  return view;
}

/// Whether all its numbers are finite; several touches may leave restitution without a meaning.
inline bool is_number(const ImpactRecord& row) {
  const ImpactNumbers& n = row.value;
  const double sum = n.start + n.duration + n.inclination + n.contact_angle + n.approach_speed + n.impulse.sum() +
                     n.peak_force + n.peak_time + n.velocity_after.sum() + n.angular_velocity_after.sum() +
                     n.energy_before + n.energy_after + n.energy_loss + n.work_damping + n.work_friction +
                     n.work_released;
  return std::isfinite(sum) && (std::isfinite(n.restitution) || row.touches > 1);
}

/// The same friction whether it sticks or slides.
inline Ground with_friction(Ground ground, double friction) {
  ground.static_friction = ground.sliding_friction = friction;
  return ground;
}

/// One impact without estimates, so that the work is one run's.
inline const Request plain{.impacts = 1, .error_estimates = false, .amplification = false};
/// The same with more impacts.
inline Request plain_impacts(int impacts) {
  return {.impacts = impacts, .error_estimates = false, .amplification = false};
}

inline World weightless(const Ground& ground, bool planar = false) {
  return {.ground = ground, .gravity = 0, .planar = planar};
}

inline Simulation dropped(const Body& body, const World& world, double angle, double speed,
                          const Accuracy& accuracy = {}, const Observer& observer = {}) {
  return simulate(body, world, touching_state(body, {.inclination = angle, .velocity = {0, 0, -speed}}), plain,
                  accuracy, observer);
}

}  // namespace clatter::numeric::test
