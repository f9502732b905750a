// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/space_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analytic/base/errors.hpp"
#include "analytic/space/body.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/discrete_scene.hpp"
#include "validation/scene/hull.hpp"

namespace clatter::validation::inline scene {
namespace {

namespace space = analytic::space;
using numeric::Vector3;

/// The points that the convex hull of all needs, each once.
std::vector<Vector3> hull_corners(const std::vector<Vector3>& points, double size) {
  constexpr double same = 1e-9;  // of the size, as is_outside_hull has it
  std::vector<Vector3> distinct;
  for (const Vector3& point : points) {
    const auto equals = [&](const Vector3& other) { return (other - point).norm() <= same * size; };
    if (std::none_of(distinct.begin(), distinct.end(), equals)) distinct.push_back(point);
  }
  std::vector<Vector3> corners;
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    std::vector<Vector3> others = distinct;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (others.empty() || is_outside_hull(distinct[i], others)) corners.push_back(distinct[i]);
  }
  return corners;
}

/// Height of the centre of mass above the lowest vertex or rim.
double touch_height(const space::Body& body, const space::Quaternion& attitude) {
  const space::Vector3 up = attitude.conjugate() * space::Vector3::UnitZ();
  double lowest = std::numeric_limits<double>::infinity();
  for (const space::Vector3& vertex : body.vertices) lowest = std::fmin(lowest, up.dot(vertex));
  for (const space::Rim& rim : body.rims)
    lowest = std::fmin(lowest, up.dot(rim.centre) - rim.radius * up.cross(rim.axis).norm());
  return -lowest;
}

/// By sizes alone, about the centre of mass.
space::Body simple_body(const Scene& scene) {
  const BodyScene& body = scene.body;
  const BodyProperties properties = nominal_properties(scene);
  space::Body made = body.shape == BodyScene::Shape::rod
                         ? space::cylinder(body.mass, {.length = body.length, .radius = body.radius})
                         : space::box(body.mass, {.size = body.size, .centre = Vector3::Zero()});
  if (!body.inertia.empty()) made.inertia = body.mass * properties.gyration_square;
  for (space::Vector3& vertex : made.vertices) vertex -= properties.centre;
  for (space::Rim& rim : made.rims) rim.centre -= properties.centre;
  return made;
}

/// The outline of a body that is symmetric about the plane; none if it has no such outline.
std::optional<analytic::PlanarBody> symmetric_outline(const numeric::Body& body) {
  try {
    return planar_body(body);
  } catch (const analytic::OutsideModelError&) {
    return std::nullopt;
  }
}

}  // namespace

bool is_planar(const Scene& scene, const numeric::Body& body) {
  return reason_in_space(scene).empty() && symmetric_outline(body).has_value();
}

space::Body space_body(const numeric::Body& body) {
  return space::polyhedron(hull_corners(body.facets().vertices, body.radius()),
                           {.mass = body.mass(), .centre = Vector3::Zero(), .inertia = body.inertia()});
}

space::Drop space_drop(const Scene& scene, const numeric::Body& body) {
  const numeric::Ground& ground = scene.world.ground;
  if (ground.has_friction() && ground.friction == numeric::FrictionLaw::regularised) {
    throw analytic::OutsideModelError(
        "the discrete model has Coulomb's law; regularised friction creeps instead of sticking");
  }
  const numeric::MotionState start = scene.start(body);
  space::Drop drop{.body = space_body(body),
                   .attitude = start.attitude,
                   .velocity = start.velocity,
                   .angular_velocity = scene.touch_angular_velocity(),
                   .gravity = scene.world.gravity,
                   .law = {}};
  drop.law.law = {.law = analytic::RestitutionLaw::viscoelastic,
                  .damping_per_stiffness = ground.damping / ground.stiffness};
  if (ground.has_friction()) {
    drop.law.law.friction = analytic::FrictionKind::coulomb;
    drop.law.law.friction_value = ground.sliding_friction;
  }
  return drop;
}

space::Drop impact_space_drop(const Scene& scene, space::Body body) {
  space::Drop drop{.body = std::move(body),
                   .attitude = scene.touch_attitude(),
                   .velocity = scene.touch_velocity(),
                   .angular_velocity = scene.touch_angular_velocity(),
                   .gravity = scene.world.gravity,
                   .law = {}};
  drop.law.law = impact_law(scene);
  if (scene.height) drop.velocity.z() = -scene.fallen_speed(touch_height(drop.body, drop.attitude));
  return drop;
}

DiscreteBody::DiscreteBody(const Scene& scene)
    : scene_(scene), centre_(body_properties(scene, Model::discrete).centre) {
  if (scene.body.shape == BodyScene::Shape::mesh) solid_ = scene.make_body();
}

const std::optional<analytic::PlanarBody>& DiscreteBody::outline() {
  if (!has_looked_for_outline_) outline_ = solid_ ? symmetric_outline(*solid_) : nominal_body(scene_);
  has_looked_for_outline_ = true;
  return outline_;
}

const space::Body& DiscreteBody::in_space() {
  if (!in_space_) in_space_ = solid_ ? space_body(*solid_) : simple_body(scene_);
  return *in_space_;
}

DiscreteDrop DiscreteBody::drop(const Scene& scene) {
  if (reason_in_space(scene).empty() && outline()) return impact_drop(scene, *outline());
  return impact_space_drop(scene, in_space());
}

DiscreteDrop chosen_drop(const Scene& scene) { return DiscreteBody(scene).drop(scene); }

DiscreteDrop chosen_drop(const Scene& scene, const numeric::Body& body) {
  if (is_planar(scene, body)) return discrete_drop(scene, body);
  return space_drop(scene, body);
}

std::string corner_name(const Scene& scene, const space::Corner& corner) {
  const std::vector<double>& centre = scene.body.centre;
  const bool is_moved = !centre.empty() && scene.body.shape != BodyScene::Shape::mesh;
  const double x = corner.place.x() + (is_moved ? centre[0] : 0), y = corner.place.y() + (is_moved ? centre[1] : 0),
               z = corner.place.z() + (is_moved ? centre[2] : 0);
  const auto sign = [](double coordinate) { return coordinate < 0 ? '-' : '+'; };
  switch (scene.body.shape) {
    case BodyScene::Shape::rod: return x < 0 ? "a" : "b";
    case BodyScene::Shape::box: return fmt::format("{}x{}y{}z", sign(x), sign(y), sign(z));
    case BodyScene::Shape::mesh: break;
  }
  return std::to_string(corner.index + 1);
}

std::string tilt_words(const space::OutcomeSet& set) {
  const std::string outcomes = set.varies ? "outcomes that change with the direction of the tilt,"
                                          : fmt::format("{} outcomes,", set.outcomes.size());
  return fmt::format("small tilts give {} up to {} m/s and {} rad/s apart", outcomes,
                     significant(set.velocity_spread, 2), significant(set.angular_velocity_spread, 2));
}

std::string landing_words(const std::vector<space::Corner>& corners) {
  if (corners.front().radius > 0) return "a round end lands level";
  return fmt::format("{} corners land at once", corners.size());
}

std::vector<SpaceRow> space_rows(const Scene& scene, const space::Sequence& sequence, const Vector3& centre) {
  std::vector<SpaceRow> rows;
  for (const space::ImpactRow& row : sequence.rows) {
    SpaceRow named{.row = row, .n = static_cast<int>(rows.size()) + 1};
    bool left = false, right = false;
    for (const space::Corner& corner : row.corners) {
      (corner.place.x() + centre.x() < 0 ? left : right) = true;
      named.corners += (named.corners.empty() ? "" : " ") + corner_name(scene, corner);
    }
    named.end = left && right ? "both" : left ? "a" : "b";
    const Vector3 place = row.corners.front().place + centre;
    named.place = {place.x(), place.y(), place.z()};
    rows.push_back(named);
  }
  return rows;
}

}  // namespace clatter::validation::inline scene
