#include "validation/scene/discrete_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analytic/body_motion.hpp"
#include "analytic/errors.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {
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

/// The lowest vertices at each corner must lie about the plane y = 0, else the contact twists the body out of it.
void require_symmetric(const numeric::Body& body, const std::vector<Vertex>& corners) {
  const double size = body.radius();
  const numeric::Matrix3& inertia = body.inertia();
  const double product = std::max(std::fabs(inertia(0, 1)), std::fabs(inertia(1, 2)));
  if (!(product <= symmetry * body.mass() * size * size))
    outside("the body's products of inertia turn it out of its plane");
  for (const Vertex& corner : corners) {
    double low = 0, high = 0;
    bool first = true;
    for (const Vector3& vertex : body.facets().vertices) {
      if (std::hypot(vertex.x() - corner.x, vertex.z() - corner.z) > symmetry * size) continue;
      low = first ? vertex.y() : std::min(low, vertex.y());
      high = first ? vertex.y() : std::max(high, vertex.y());
      first = false;
    }
    if (!(std::fabs(low + high) <= symmetry * size)) outside("the body's corners do not lie about its plane y = 0");
  }
}

/// Downward speed at the touch, of a centre of mass that fell from `height`.
double fallen_speed(double height, double gravity, const analytic::PlanarBody& body,
                    const analytic::Angle& inclination) {
  const double touch = analytic::BodyMotion(body, inclination, {}, 0).centre_height();
  if (!(height > touch)) {
    throw BadInput(
        fmt::format("drop.height = {}: must be greater than {} m, the height of the centre of mass at the "
                    "first touch",
                    shortest(height), significant(touch, 6)));
  }
  return std::sqrt(2 * gravity * (height - touch));
}

}  // namespace

analytic::PlanarBody planar_body(const numeric::Body& body) {
  std::vector<Vertex> points;
  for (const Vector3& vertex : body.facets().vertices) points.push_back({vertex.x(), vertex.z()});
  std::vector<Vertex> corners = convex_hull(points, body.radius());
  if (corners.size() > static_cast<std::size_t>(analytic::max_vertices)) {
    outside(fmt::format("the body's outline has {} corners, at most {} are possible", corners.size(),
                        analytic::max_vertices));
  }
  require_symmetric(body, corners);
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
  if (scene.tilt_deg != 0) outside("drop.tilt_deg turns the body out of it");
  const numeric::Ground& ground = scene.ground;
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
          .velocity = {.normal = start.velocity.z(), .tangential = start.velocity.x(), .angular = scene.spin},
          .gravity = scene.options.gravity,
          .law = law};
}

analytic::PlanarBody nominal_body(const Scene& scene) {
  const BodyScene& body = scene.body;
  switch (body.shape) {
    case BodyScene::Shape::rod:
      return analytic::make_rod({.mass = body.mass, .length = body.length, .radius = body.radius});
    case BodyScene::Shape::box:
      return analytic::make_box(
          {.mass = body.mass, .length = body.size.x(), .width = body.size.y(), .thickness = body.size.z()});
    case BodyScene::Shape::mesh: break;
  }
  return planar_body(scene.make_body());
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
  if (scene.tilt_deg != 0) outside("drop.tilt_deg turns the body out of it");
  const analytic::Angle inclination = analytic::Angle::from_degrees(scene.angle_deg);
  const double gravity = scene.options.gravity;
  const double speed = scene.height ? fallen_speed(*scene.height, gravity, body, inclination) : scene.speed;
  return {.body = body,
          .inclination = inclination,
          .velocity = {.normal = -speed, .tangential = scene.tangential_velocity, .angular = scene.spin},
          .gravity = gravity,
          .law = impact_law(scene)};
}

analytic::Drop impact_drop(const Scene& scene) { return impact_drop(scene, nominal_body(scene)); }

Scene read_discrete_scene(const SceneValues& values, const std::vector<SceneOverride>& overrides) {
  Scene scene = read_scene(values, overrides, Model::discrete);
  if (scene.sweep && scene.sweep->quantity == SceneSweep::Quantity::angle_deg) {
    throw BadInput(fmt::format("{}: sweep.angle_deg: must be left out here; give --angle", values.path()));
  }
  if (scene.height) scene.speed = -impact_drop(scene).velocity.normal;
  return scene;
}

}  // namespace clatter::validation
