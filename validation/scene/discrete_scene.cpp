// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/discrete_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/plane/body_motion.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/space_scene.hpp"

namespace clatter::validation::inline scene {
namespace {

using analytic::Vertex;
using numeric::Vector3;

constexpr double symmetry = 1e-9;  // of the body's size: meshes from files carry the rounding of their text

[[noreturn]] void outside(const std::string& why) {
  throw analytic::OutsideModelError("the discrete model is planar: " + why);
}

/// Twice the area of the triangle o, a, b; positive counter-clockwise.
double cross(const Vertex& o, const Vertex& a, const Vertex& b) {
  return (a.x - o.x) * (b.z - o.z) - (a.z - o.z) * (b.x - o.x);
}

/// Corners of the convex hull, counter-clockwise (Andrew's monotone chain); points on an edge are left out.
std::vector<Vertex> convex_hull(std::vector<Vertex> points, double size) {
  std::sort(points.begin(), points.end(),
            [](const Vertex& a, const Vertex& b) { return a.x != b.x ? a.x < b.x : a.z < b.z; });
  const double flat = symmetry * size * size;
  std::vector<Vertex> hull;
  const auto half = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= base + 2 && cross(hull[hull.size() - 2], hull.back(), *point) <= flat) hull.pop_back();
      hull.push_back(*point);
    }
    hull.pop_back();  // the first of the other half
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  return hull;
}

/// The corners of the outline in the x–z plane.
std::vector<Vertex> outline(const numeric::Body& body) {
  std::vector<Vertex> points;
  for (const Vector3& vertex : body.facets().vertices) points.push_back({vertex.x(), vertex.z()});
  return convex_hull(points, body.radius());
}

/// The lowest vertices at each corner must lie about the plane y = 0, else the contact twists the body out of it.
std::string asymmetry(const numeric::Body& body, const std::vector<Vertex>& corners) {
  const double size = body.radius();
  const numeric::Matrix3& inertia = body.inertia();
  const double product = std::max(std::fabs(inertia(0, 1)), std::fabs(inertia(1, 2)));
  if (!(product <= symmetry * body.mass() * size * size)) return "the products of its body.inertia turn it";
  for (const Vertex& corner : corners) {
    double low = 0, high = 0;
    bool first = true;
    for (const Vector3& vertex : body.facets().vertices) {
      if (std::hypot(vertex.x() - corner.x, vertex.z() - corner.z) > symmetry * size) continue;
      low = first ? vertex.y() : std::min(low, vertex.y());
      high = first ? vertex.y() : std::max(high, vertex.y());
      first = false;
    }
    if (!(std::fabs(low + high) <= symmetry * size)) {
      return "body.centre and the corners do not lie about its plane y = 0";
    }
  }
  return "";
}

/// Whether the parts are zero next to the whole, but for the rounding of what a program typed.
bool vanish(std::initializer_list<double> parts, double whole) {
  constexpr double typed = 1e-14;
  return std::all_of(parts.begin(), parts.end(), [&](double part) { return std::fabs(part) <= typed * whole; });
}

[[noreturn]] void in_space(const std::string& reason) { outside("the body moves in space: " + reason); }

void require_plane(const Scene& scene) {
  const std::string reason = reason_in_space(scene);
  if (!reason.empty()) in_space(reason);
}

}  // namespace

std::string reason_in_space(const Scene& scene) {
  const auto given = [&](const char* key) { return fmt::format("{} = {}", key, key_named(key).get(scene).dump()); };
  const Eigen::Quaterniond turn = scene.touch_attitude();
  if (scene.attitude.empty() && scene.tilt_deg != 0) return "drop.tilt_deg turns it out of its plane";
  if (!scene.attitude.empty() && !vanish({turn.x(), turn.z()}, 1)) {
    return given("drop.attitude") + " is more than an inclination, (q0, 0, q2, 0)";
  }
  const Vector3 velocity = scene.touch_velocity(), rate = scene.touch_angular_velocity();
  if (!vanish({velocity.y()}, velocity.norm())) return given("drop.velocity") + " has a part across its plane";
  if (!vanish({rate.x(), rate.z()}, rate.norm())) {
    return given("drop.angular_velocity") + " has a part that is not about y";
  }
  const std::vector<double>&centre = scene.body.centre, &inertia = scene.body.inertia;
  const bool is_about_plane = scene.body.shape != BodyScene::Shape::mesh;  // a mesh's plane is where its corners say
  if (is_about_plane && !centre.empty() && centre[1] != 0) return given("body.centre") + " lies off the plane y = 0";
  if (inertia.size() == 6 && !vanish({inertia[3], inertia[5]}, *std::max_element(inertia.begin(), inertia.end()))) {
    return given("body.inertia") + " has no principal axis y";
  }
  return "";
}

analytic::PlanarBody planar_body(const numeric::Body& body) {
  std::vector<Vertex> corners = outline(body);
  if (corners.size() > static_cast<std::size_t>(analytic::max_vertices)) {
    outside(fmt::format("the body's outline has {} corners, at most {} are possible", corners.size(),
                        analytic::max_vertices));
  }
  const std::string reason = asymmetry(body, corners);
  if (!reason.empty()) in_space(reason);
  // a and b are the lower ones at each end.
  std::sort(corners.begin(), corners.end(), [](const Vertex& p, const Vertex& q) { return p.z < q.z; });
  for (std::size_t i = 0; i + 1 < corners.size(); i += 2) {
    if (corners[i].x > corners[i + 1].x) std::swap(corners[i], corners[i + 1]);
  }
  analytic::PlanarBody planar{.mass = body.mass(),
                              .gyration_square = body.inertia()(1, 1) / body.mass(),
                              .vertex_count = static_cast<int>(corners.size())};
  std::copy(corners.begin(), corners.end(), planar.vertices.begin());
  return planar;
}

analytic::Drop discrete_drop(const Scene& scene, const numeric::Body& body) {
  require_plane(scene);
  const numeric::Ground& ground = scene.world.ground;
  if (ground.has_friction() && ground.friction == numeric::FrictionLaw::regularised) {
    outside("and has Coulomb's law; regularised friction creeps instead of sticking");
  }
  const numeric::MotionState start = scene.start(body);
  analytic::ImpactLaw law{.law = analytic::RestitutionLaw::viscoelastic,
                          .damping_per_stiffness = ground.damping / ground.stiffness};
  if (ground.has_friction()) {
    law.friction = analytic::FrictionKind::coulomb;
    law.friction_value = ground.sliding_friction;
  }
  return {.body = planar_body(body),
          .inclination = analytic::Angle::from_degrees(scene.angle_deg),
          .velocity = {.normal = start.velocity.z(),
                       .tangential = start.velocity.x(),
                       .angular = scene.touch_angular_velocity().y()},
          .gravity = scene.world.gravity,
          .law = law};
}

analytic::PlanarBody nominal_body(const Scene& scene) {
  const BodyScene& body = scene.body;
  if (body.shape == BodyScene::Shape::mesh) return planar_body(scene.make_body());
  analytic::PlanarBody planar =
      body.shape == BodyScene::Shape::rod
          ? analytic::make_rod({.mass = body.mass, .length = body.length, .radius = body.radius})
          : analytic::make_box(
                {.mass = body.mass, .length = body.size.x(), .width = body.size.y(), .thickness = body.size.z()});
  const BodyProperties properties = nominal_properties(scene);
  if (!body.inertia.empty()) planar.gyration_square = properties.gyration_square(1, 1);
  for (Vertex& vertex : planar.vertices) {
    vertex.x -= properties.centre.x();
    vertex.z -= properties.centre.z();
  }
  planar.uniform_thin_rod = planar.uniform_thin_rod && body.inertia.empty() && properties.centre.isZero(0);
  return planar;
}

analytic::ImpactLaw impact_law(const Scene& scene) {
  const DiscreteImpact& impact = scene.impact;
  analytic::ImpactLaw law{.restitution = impact.restitution, .law = impact.law};
  if (impact.impulse_ratio) {
    law.friction = analytic::FrictionKind::impulse_ratio;
    law.friction_value = *impact.impulse_ratio;
  }
  if (impact.friction) {
    law.friction = analytic::FrictionKind::coulomb;
    law.friction_value = *impact.friction;
  }
  return law;
}

analytic::Drop impact_drop(const Scene& scene, const analytic::PlanarBody& body) {
  require_plane(scene);
  const analytic::Angle inclination = analytic::Angle::from_degrees(scene.angle_deg);
  const double gravity = scene.world.gravity;
  const Vector3 velocity = scene.touch_velocity();
  const auto touch = [&] { return analytic::BodyMotion(body, inclination, {}, 0).centre_height(); };
  const double normal = scene.height ? -scene.fallen_speed(touch()) : velocity.z();
  return {.body = body,
          .inclination = inclination,
          .velocity = {.normal = normal, .tangential = velocity.x(), .angular = scene.touch_angular_velocity().y()},
          .gravity = gravity,
          .law = impact_law(scene)};
}

analytic::Drop impact_drop(const Scene& scene) { return impact_drop(scene, nominal_body(scene)); }

Scene read_discrete_scene(const SceneValues& values, const std::vector<SceneOverride>& overrides) {
  Scene scene = read_scene(values, overrides, Model::discrete);
  if (scene.sweep && scene.sweep->quantity == SceneSweep::Quantity::angle_deg) {
    throw BadInput(fmt::format("{}: sweep.angle_deg: must be left out here; give --angle", values.path()));
  }
  if (scene.height) {
    const DiscreteDrop drop = chosen_drop(scene);
    const auto* const planar = std::get_if<analytic::Drop>(&drop);
    scene.speed = planar ? -planar->velocity.normal : -std::get<analytic::space::Drop>(drop).velocity.z();
  }
  return scene;
}

}  // namespace clatter::validation::inline scene
