// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/discrete_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analytic/base/errors.hpp"
#include "analytic/law/viscoelastic.hpp"
#include "analytic/plane/impact_rows.hpp"
#include "analytic/space/flight/body.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/run/states.hpp"
#include "validation/scene/hull.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using analytic::RestitutionLaw;
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
    if (!(std::fabs(low + high) <= symmetry * size))
      return "body.centre and the corners do not lie about its plane y = 0";
  }
  return "";
}

/// Whether the parts are zero next to the whole, but for the rounding of what a program typed.
bool vanish(std::initializer_list<double> parts, double whole) {
  constexpr double typed = 1e-14;
  return std::all_of(parts.begin(), parts.end(), [&](double part) { return std::fabs(part) <= typed * whole; });
}

/// By sizes alone, about the centre of mass.
space::Body simple_body(const Scene& scene) {
  const BodyScene& body = scene.body;
  const BodyProperties properties = body_properties(scene, Model::discrete);
  space::Body made = body.is_round() ? round_body(body)
                     : body.shape == BodyScene::Shape::rod
                         ? space::cylinder(body.mass, {.length = body.length, .radius = body.radius})
                         : space::box(body.mass, {.size = body.size, .centre = Vector3::Zero()});
  if (!body.inertia.empty()) made.inertia = body.mass * properties.gyration_square;
  for (space::Vector3& vertex : made.vertices) vertex -= properties.centre;
  for (space::Rim& rim : made.rims) rim.centre -= properties.centre;
  for (space::Ellipsoid& part : made.ellipsoids) part.centre -= properties.centre;
  return made;
}

/// The outline by sizes alone, about the centre of mass.  Domain: a rod or box.
analytic::PlanarBody simple_outline(const Scene& scene) {
  const BodyScene& body = scene.body;
  analytic::PlanarBody planar =
      body.shape == BodyScene::Shape::rod
          ? analytic::make_rod({.mass = body.mass, .length = body.length, .radius = body.radius})
          : analytic::make_box(
                {.mass = body.mass, .length = body.size.x(), .width = body.size.y(), .thickness = body.size.z()});
  const BodyProperties properties = body_properties(scene, Model::discrete);
  if (!body.inertia.empty()) planar.gyration_square = properties.gyration_square(1, 1);
  for (Vertex& vertex : planar.vertices) {
    vertex.x -= properties.centre.x();
    vertex.z -= properties.centre.z();
  }
  planar.uniform_thin_rod = planar.uniform_thin_rod && body.inertia.empty() && properties.centre.isZero(0);
  return planar;
}

/// The outline of a body that is symmetric about the plane; none if it has no such outline.
std::optional<analytic::PlanarBody> symmetric_outline(const numeric::Body& body) {
  try {
    return planar_body(body);
  } catch (const analytic::OutsideModelError&) {
    return std::nullopt;
  }
}

/// Motion and law of a drop in the plane.
analytic::Drop planar_drop(const Scene& scene, const analytic::PlanarBody& body) {
  const analytic::Angle inclination = analytic::Angle::from_degrees(scene.angle_deg);
  const Vector3 velocity = scene.touch_velocity();
  const double touch = touch_height(body, inclination);
  const double normal = scene.height ? -scene.fallen_speed(touch) : velocity.z();
  analytic::Drop drop{
      .body = body,
      .inclination = inclination,
      .velocity = {.normal = normal, .tangential = velocity.x(), .angular = scene.touch_angular_velocity().y()},
      .gravity = scene.world.pull().down,
      .gravity_along = scene.world.pull().along,
      .law = discrete_law(scene).law};
  if (!scene.is_released()) return drop;
  drop.release_height = scene.release_height(touch);
  return analytic::after_free_fall(drop);
}

/// The same in space, where an impulse ratio acts along x.
space::Drop space_drop(const Scene& scene, const space::Body& body) {
  space::Drop drop{.body = body,
                   .attitude = scene.touch_attitude(),
                   .velocity = scene.touch_velocity(),
                   .angular_velocity = scene.touch_angular_velocity(),
                   .gravity = scene.world.pull().down,
                   .gravity_along = scene.world.pull().along,
                   .law = {}};
  drop.law = discrete_law(scene).law;
  if (scene.height) drop.velocity.z() = -scene.fallen_speed(touch_height(drop.body, drop.attitude));
  if (scene.is_released()) drop.release_height = scene.release_height(touch_height(drop.body, drop.attitude));
  return drop;
}

/// Whether the sequence in the plane ends while the body still turns on an end that stays on the ground.
bool stays_on_an_end(const Scene& scene, const analytic::Drop& drop) {
  if (!(drop.gravity > 0)) return false;
  try {
    const analytic::SequenceOptions options{
        .impacts = scene.most_impacts(), .digits = scene.accuracy.digits, .amplification = false, .until_rest = true};
    return impact_sequence(drop, options).outcome == analytic::Outcome::sustained_contact;
  } catch (const std::exception&) {  // which the run itself will tell
    return false;
  }
}

/// Corners of the two bodies, each matched by one of the other's.
template <class Places>
bool same_places(const Places& some, const Places& others, double size) {
  constexpr double same = 1e-9;  // of the size, as is_outside_hull has it
  const auto near = [&](const auto& one) {
    return std::any_of(others.begin(), others.end(),
                       [&](const auto& other) { return (one - other).norm() <= same * size; });
  };
  return some.size() == others.size() && std::all_of(some.begin(), some.end(), near);
}

std::vector<Eigen::Vector2d> places_of(const analytic::PlanarBody& body) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < body.vertex_count; ++i) {
    const Vertex& vertex = body.vertices[static_cast<std::size_t>(i)];
    places.emplace_back(vertex.x, vertex.z);
  }
  return places;
}

/// A place from the centre of mass as one from the geometric centre of a rod or box.
Vector3 from_geometric_centre(const Scene& scene, const Vector3& place) {
  const std::vector<double>& centre = scene.body.centre;
  const bool is_moved = !centre.empty() && !scene.body.is_polyhedron();
  return is_moved ? Vector3(place + vector_of(centre)) : place;
}

/// Name of the corner of a box, or of the end of a rod or capsule, on one side of the geometric centre along each axis.
std::string side_name(BodyScene::Shape shape, const Vector3& side) {
  if (shape == BodyScene::Shape::sphere || shape == BodyScene::Shape::ellipsoid) return "surface";
  if (shape != BodyScene::Shape::box) return side.x() < 0 ? "a" : "b";
  const auto sign = [](double coordinate) { return coordinate < 0 ? '-' : '+'; };
  return fmt::format("{}x{}y{}z", sign(side.x()), sign(side.y()), sign(side.z()));
}

const char* source_name(LawSource source, const char* of_ground) {
  return source == LawSource::standard ? "default" : source == LawSource::impact ? "impact" : of_ground;
}

std::string law_friction_words(const Scene& scene, const DiscreteLaw& law) {
  const bool is_swept = scene.sweep && scene.sweep->quantity == SceneSweep::Quantity::friction;
  if (is_swept && law.friction_from != LawSource::impact) return "Coulomb friction as swept";
  const std::string value = shortest(law.law.friction_value);
  const char* const from = law.friction_from == LawSource::ground ? ", from the ground" : "";
  switch (law.law.friction) {
    case analytic::FrictionKind::coulomb: return fmt::format("Coulomb friction μ = {}{}", value, from);
    case analytic::FrictionKind::moreau:
      return fmt::format("friction μ = {}{} by the slip after the impact (Moreau)", value, from);
    case analytic::FrictionKind::impulse_ratio: return fmt::format("impulse ratio μᵢ = {}", value);
    case analytic::FrictionKind::none: break;
  }
  return "no friction";
}

/// Fills in which end and corners of the body strike, and where.
void name_corners(const Scene& scene, const space::ImpactRow& row, const Vector3& centre, Impact& impact) {
  bool left = false, right = false;
  for (const space::Corner& corner : row.corners) {
    (corner.place.x() + centre.x() < 0 ? left : right) = true;
    if (!impact.corners.empty()) impact.corners += ' ';
    impact.corners += corner_name(scene, corner);
  }
  impact.end = left && right ? "both" : left ? "a" : "b";
  const Vector3 place = row.corners.front().place + centre;
  impact.place = {place.x(), place.y(), place.z()};
}

double ground_restitution(const DiscreteLaw& law, double approach) {
  return analytic::restitution_of_damping(law.law.damping_per_stiffness * approach);
}

std::string restitution_words(const DiscreteLaw& law, std::optional<double> approach) {
  if (law.restitution_from != LawSource::ground)
    return fmt::format("e = {} ({})", shortest(law.law.restitution), law_name(law.law.law));
  if (!(law.law.damping_per_stiffness > 0)) return "e = 1 (viscoelastic), from the ground without damping";
  if (!approach) {
    return fmt::format("e from the ground's damping (viscoelastic, c/k = {} s/m)",
                       significant(law.law.damping_per_stiffness, 6));
  }
  return fmt::format("e = {} at {} m/s (viscoelastic), from the ground's damping",
                     significant(ground_restitution(law, *approach), 3), significant(*approach, 3));
}

}  // namespace

DiscreteLaw discrete_law(const Scene& scene) {
  const DiscreteImpact& impact = scene.impact;
  const numeric::Ground& ground = scene.world.ground;
  DiscreteLaw found{.law = {.restitution = impact.restitution.value_or(1), .law = restitution_law(scene)}};
  analytic::ImpactLaw& law = found.law;
  if (impact.restitution || impact.law) found.restitution_from = LawSource::impact;
  if (law.law == RestitutionLaw::viscoelastic) {
    found.restitution_from = LawSource::ground;
    law.damping_per_stiffness = ground.damping_per_stiffness();
  }
  if (impact.impulse_ratio || impact.friction) {
    found.friction_from = LawSource::impact;
    law.friction = impact.friction ? analytic::FrictionKind::coulomb : analytic::FrictionKind::impulse_ratio;
    law.friction_value = impact.friction ? *impact.friction : *impact.impulse_ratio;
  } else if (takes_friction_of_ground(scene)) {
    if (ground.friction == numeric::FrictionLaw::regularised) {
      throw analytic::OutsideModelError(
          "the discrete model has Coulomb's law; regularised friction creeps instead of sticking");
    }
    found.friction_from = LawSource::ground;
    law.friction = analytic::FrictionKind::coulomb;
    law.friction_value = ground.sliding_friction;
  }
  if (scene.impact.is_moreau) law.friction = analytic::FrictionKind::moreau;
  return found;
}

std::string other_law_words(const Scene& scene, double approach) {
  const DiscreteImpact& impact = scene.impact;
  const numeric::Ground& ground = scene.world.ground;
  const double e = analytic::restitution_of_damping(ground.damping_per_stiffness() * approach);
  std::string words;
  if (impact.restitution && *impact.restitution != e) {
    const std::string given = shortest(*impact.restitution), own = significant(e, 3);
    words = std::fabs(*impact.restitution - e) < 5e-4
                ? fmt::format("e = {} at any speed where the ground has that at {} m/s alone", given,
                              significant(approach, 3))
                : fmt::format("e = {} where the ground has {} at {} m/s", given, own, significant(approach, 3));
  }
  const bool has_friction = impact.impulse_ratio || impact.friction;
  if (has_friction && (!impact.friction || *impact.friction != ground.sliding_friction)) {
    words += fmt::format("{}{} where the ground has μ = {}", words.empty() ? "" : ", ",
                         impact.friction ? fmt::format("μ = {}", shortest(*impact.friction))
                                         : fmt::format("an impulse ratio of {}", shortest(*impact.impulse_ratio)),
                         shortest(ground.sliding_friction));
  }
  return words;
}

std::string other_law_remark(const Scene& scene, const numeric::Simulation& run) {
  if (run.impacts.empty()) return "";
  const std::string words = other_law_words(scene, run.impacts.front().value.approach_speed);
  if (words.empty()) return "";
  return fmt::format("the law of [impact] is the discrete model's alone: {}{}", words,
                     words.starts_with("e = ") ? "; clatter shock --ground finds the damping for it" : "");
}

std::string reason_in_space(const Scene& scene) {
  const auto given = [&](const char* key) {
    return fmt::format("{} = {}", key, compact_json(key_named(key).get(scene)));
  };
  if (scene.body.is_round()) return given("body.shape") + " has no corners in a plane";
  if (scene.attitude.empty()) {
    if (scene.tilt_deg != 0) return "drop.tilt_deg turns it out of its plane";
  } else if (const Eigen::Quaterniond turn = scene.touch_attitude(); !vanish({turn.x(), turn.z()}, 1)) {
    return given("drop.attitude") + " is more than an inclination, (q0, 0, q2, 0)";
  }
  const Vector3 velocity = scene.touch_velocity(), rate = scene.touch_angular_velocity();
  if (!vanish({velocity.y()}, velocity.norm())) return given("drop.velocity") + " has a part across its plane";
  if (!vanish({rate.x(), rate.z()}, rate.norm()))
    return given("drop.angular_velocity") + " has a part that is not about y";
  const std::vector<double>&centre = scene.body.centre, &inertia = scene.body.inertia;
  const bool is_about_plane = !scene.body.is_polyhedron();  // a mesh's plane is where its corners say
  if (is_about_plane && !centre.empty() && centre[1] != 0) return given("body.centre") + " lies off the plane y = 0";
  if (inertia.size() == 6 && !vanish({inertia[3], inertia[5]}, *std::max_element(inertia.begin(), inertia.end())))
    return given("body.inertia") + " has no principal axis y";
  return "";
}

analytic::PlanarBody planar_body(const numeric::Body& body) {
  std::vector<Vertex> corners = outline(body);
  if (corners.size() > static_cast<std::size_t>(analytic::max_vertices)) {
    outside(fmt::format("the body's outline has {} corners, at most {} are possible", corners.size(),
                        analytic::max_vertices));
  }
  const std::string reason = asymmetry(body, corners);
  if (!reason.empty()) outside("the body moves in space: " + reason);
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

space::Body space_body(const numeric::Body& body) {
  return space::polyhedron(hull_corners(body.facets().vertices, body.radius()),
                           {.mass = body.mass(), .centre = Vector3::Zero(), .inertia = body.inertia()});
}

const analytic::ImpactLaw& law_of(const DiscreteDrop& drop) {
  if (const auto* const planar = std::get_if<analytic::Drop>(&drop)) return planar->law;
  return std::get<space::Drop>(drop).law;
}

double first_approach_speed(const DiscreteDrop& drop) {
  double lowest = std::numeric_limits<double>::infinity(), speed = 0;
  const auto take = [&](double height, double down, double size) {
    const bool is_level = std::fabs(height - lowest) <= 1e-12 * size;
    if (height < lowest || is_level) speed = is_level ? std::fmax(speed, down) : down;
    lowest = std::fmin(lowest, height);
  };
  if (const auto* const planar = std::get_if<analytic::Drop>(&drop)) {
    const double sine = std::sin(planar->inclination.radians), cosine = std::cos(planar->inclination.radians);
    const double reach = planar->body.reach();
    for (int i = 0; i < planar->body.vertex_count; ++i) {
      const analytic::ContactPoint d = planar->body.contact_point(i, sine, cosine);
      take(d.normal, -normal_velocity(planar->velocity, d), reach);
    }
    return speed;
  }
  const auto& in_space = std::get<space::Drop>(drop);
  if (in_space.release_height)
    return impact_sequence(in_space, {.impacts = 1, .amplification = false}).rows.front().impact.approach_speed;
  const auto at = [&, reach = in_space.body.reach()](const Vector3& arm) {
    take(arm.z(), -(in_space.velocity + in_space.angular_velocity.cross(arm)).z(), reach);
  };
  for (const Vector3& vertex : in_space.body.vertices) at(in_space.attitude * vertex);
  for (const space::Rim& rim : in_space.body.rims) {
    const Vector3 axis = in_space.attitude * rim.axis;
    const Vector3 down = axis * axis.z() - Vector3::UnitZ();  // within the rim's plane
    at(in_space.attitude * rim.centre + (down.norm() > 0 ? Vector3(rim.radius * down.normalized()) : Vector3::Zero()));
  }
  for (int i = in_space.body.points() - static_cast<int>(in_space.body.ellipsoids.size()); i < in_space.body.points();
       ++i)
    at(in_space.attitude * space::touching_place(in_space.body, in_space.attitude, i));
  return speed;
}

DiscreteBody::DiscreteBody(const Scene& scene) : centre_(body_properties(scene, Model::discrete).centre) {
  if (scene.body.is_polyhedron()) solid_ = std::make_shared<const numeric::Body>(scene.make_body());
  else scene_ = scene;
}

DiscreteBody::DiscreteBody(std::shared_ptr<const numeric::Body> solid) : solid_(std::move(solid)) {}

DiscreteBody::DiscreteBody(const numeric::Body& solid) : solid_(std::shared_ptr<void>(), &solid) {}

DiscreteBody::DiscreteBody(const Scene& scene, const numeric::Body& body)
    : DiscreteBody(scene.body.is_polyhedron() ? DiscreteBody(body) : DiscreteBody(scene)) {}

const std::optional<analytic::PlanarBody>& DiscreteBody::outline() {
  if (!has_looked_for_outline_) outline_ = solid_ ? symmetric_outline(*solid_) : simple_outline(*scene_);
  has_looked_for_outline_ = true;
  return outline_;
}

const space::Body& DiscreteBody::in_space() {
  if (!in_space_) in_space_ = solid_ ? space_body(*solid_) : simple_body(*scene_);
  return *in_space_;
}

DiscreteDrop DiscreteBody::drop(const Scene& scene) {
  if (!reason_in_space(scene).empty() || !outline()) return drop_in_space(scene);
  analytic::Drop drop = planar_drop(scene, *outline());
  if (scene.until_rest && stays_on_an_end(scene, drop)) return space_drop(scene, space::outline(*outline()));
  return drop;
}

space::Drop DiscreteBody::drop_in_space(const Scene& scene) { return space_drop(scene, in_space()); }

DiscreteDrop discrete_drop(const Scene& scene) { return DiscreteBody(scene).drop(scene); }

bool has_other_corners(const DiscreteDrop& drop, const DiscreteDrop& mesh) {
  constexpr double same = 1e-9;
  if (drop.index() != mesh.index()) return true;
  if (const auto* const one = std::get_if<analytic::Drop>(&drop)) {
    const auto& other = std::get<analytic::Drop>(mesh);
    const double k = one->body.gyration_square;
    return !(std::fabs(k - other.body.gyration_square) <= same * k) ||
           !same_places(places_of(one->body), places_of(other.body), one->body.reach());
  }
  const auto &one = std::get<space::Drop>(drop), &other = std::get<space::Drop>(mesh);
  return !one.body.rims.empty() || !one.body.ellipsoids.empty() ||
         !((one.body.inertia - other.body.inertia).norm() <= same * one.body.inertia.norm()) ||
         !same_places(one.body.vertices, other.body.vertices, one.body.reach());
}

PreparedScene prepared(Scene scene) {
  DiscreteBody body(scene);
  DiscreteDrop drop = body.drop(scene);
  if (scene.falls()) {
    const auto* const planar = std::get_if<analytic::Drop>(&drop);
    scene.speed = planar ? -planar->velocity.normal : -std::get<space::Drop>(drop).velocity.z();
  }
  return {.scene = std::move(scene), .centre = body.centre(), .drop = std::move(drop)};
}

PreparedScene read_discrete_scene(const SceneValues& values, const std::vector<SceneOverride>& overrides) {
  Scene scene = read_scene(values, overrides, Model::discrete);
  if (scene.sweep) {
    const bool is_angle = scene.sweep->quantity == SceneSweep::Quantity::angle_deg;
    if (is_angle || !(scene.impact.friction || scene.impact.impulse_ratio)) {
      throw BadInput("{}: sweep.{}: must be left out here; give {}", values.path(), scene.sweep->name(),
                     is_angle ? "--angle" : "--friction");
    }
  }
  return prepared(std::move(scene));
}

std::string law_words(const Scene& scene, std::optional<double> approach, const KeyNames& unsettled) {
  const auto is_settled = [&](std::initializer_list<std::string_view> keys) {
    return std::none_of(unsettled.begin(), unsettled.end(), [&](const std::string& name) {
      return std::find(keys.begin(), keys.end(), std::string_view(name)) != keys.end();
    });
  };
  const DiscreteLaw law = discrete_law(scene);
  const bool of_ground = law.restitution_from == LawSource::ground;
  std::string words;
  if (is_settled({"impact.restitution", "ground.damping", "ground.stiffness", "ground.dissipation"}))
    words = restitution_words(law, approach);
  if (is_settled({"impact.friction", "impact.impulse_ratio", "ground.static_friction", "ground.sliding_friction"}))
    words += (words.empty() ? "" : of_ground ? "; " : ", ") + law_friction_words(scene, law);
  return words.empty() ? "as swept" : words;
}

Value law_fields(const Scene& scene, std::optional<double> approach) {
  const DiscreteLaw found = discrete_law(scene);
  const analytic::ImpactLaw& law = found.law;
  Value fields = Value::Fields{{"law", law_name(law.law)}};
  if (found.restitution_from != LawSource::ground) fields["restitution"] = law.restitution;
  else if (approach) {
    fields["restitution"] = ground_restitution(found, *approach);
    fields["approach_speed"] = *approach;
  }
  fields["restitution_from"] = source_name(
      found.restitution_from, scene.world.ground.has_dissipation() ? "ground.dissipation" : "ground.damping");
  const char* const frictions[]{"none", "impulse-ratio", "coulomb", "moreau"};
  fields["friction_law"] = frictions[static_cast<std::size_t>(law.friction)];
  if (law.friction != analytic::FrictionKind::none) fields["friction"] = law.friction_value;
  fields["friction_from"] = source_name(found.friction_from, "ground.sliding_friction");
  return fields;
}

std::string corner_name(const Scene& scene, const space::Corner& corner) {
  if (scene.body.is_polyhedron()) return std::to_string(corner.index + 1);
  return side_name(scene.body.shape, from_geometric_centre(scene, corner.place));
}

std::string corner_names(const Scene& scene, const Vector3& place) {
  constexpr double middle = 1e-9;  // of the size: below it the mean is that of corners on both sides
  const BodyScene& body = scene.body;
  if (body.is_polyhedron()) return "";
  const bool is_rod = body.has_length();
  const Vector3 mean = from_geometric_centre(scene, place), size = is_rod ? Vector3(body.length, 0, 0) : body.size;
  if (body.is_round() && !is_rod) return side_name(body.shape, mean);
  std::string names;
  for (int corner = 0; corner < 8; corner += is_rod ? 4 : 1) {
    const auto sign = [&](int bit) { return (corner & bit) != 0 ? 1.0 : -1.0; };
    const Vector3 side(sign(4), sign(2), sign(1));
    const Vector3 beyond = side.cwiseProduct(mean) + middle * size;
    if (beyond.x() < 0 || (!is_rod && beyond.minCoeff() < 0)) continue;
    if (!names.empty()) names += ' ';
    names += side_name(body.shape, side);
  }
  return names;
}

std::string tilt_words(const space::OutcomeSet& set) {
  const std::size_t count = set.outcomes.size();
  if (count == 0) return "what small tilts give takes long to follow (--format json)";
  const std::string outcomes =
      set.varies ? "outcomes that change with the direction of the tilt,"
                 : fmt::format("{}{} outcome{},", set.is_complete() ? "" : "at least ", count, count == 1 ? "" : "s");
  std::string words = fmt::format("small tilts give {} up to {} m/s and {} rad/s apart", outcomes,
                                  significant(set.velocity_spread, 2), significant(set.angular_velocity_spread, 2));
  const auto percent = [](double share) { return significant(100 * share, 2); };
  if (!set.varies && count > 1)
    words += fmt::format(", the commonest for {} % of the directions", percent(set.outcomes.front().share));
  if (!set.is_complete()) words += fmt::format("; {} % of the directions are not followed", percent(set.open_share));
  return words;
}

std::string landing_words(const std::vector<space::Corner>& corners) {
  if (corners.front().radius > 0) return "a round end lands level";
  return fmt::format("{} corners land at once", corners.size());
}

double given_inclination(const Scene& scene) { return scene.is_released() ? no_inclination : scene.angle_deg; }

analytic::SequenceOptions sequence_options(const Scene& scene, bool with_errors) {
  return {.impacts = scene.most_impacts(),
          .digits = scene.accuracy.digits,
          .amplification = with_errors,
          .until_rest = scene.until_rest,
          .until = scene.request.until};
}

Run named_run(const Scene& scene, const DiscreteSequence& sequence, const Vector3& centre) {
  Run run;
  if (const auto* const planar = std::get_if<analytic::Sequence>(&sequence)) {
    run = run_of(*planar, given_inclination(scene));
  } else {
    const auto& in_space = std::get<space::Sequence>(sequence);
    run = run_of(in_space);
    for (std::size_t i = 0; i < run.impacts.size(); ++i) name_corners(scene, in_space.rows[i], centre, run.impacts[i]);
  }
  const bool rubs = discrete_law(scene).law.most_friction() > 0;
  settle_outcome(scene.until_rest, rubs && scene.world.incline_deg == 0, run);
  return run;
}

Run named_run(const Scene& scene, const numeric::Simulation& simulation) {
  Run run = run_of(simulation);
  for (std::size_t i = 0; i < run.impacts.size(); ++i)
    run.impacts[i].corners = corner_names(scene, simulation.impacts[i].place);
  return run;
}

std::string read_sequence_method(const std::string& option, const std::string& name) {
  if (name == "closed-form")
    throw BadInput(option + " closed-form: no longer there; discrete gives the same rows, and those after the third");
  static_cast<void>(read_name_option(option, name, {"auto", "discrete"}));
  return name;
}

namespace {

/// A planar drop as one of its outline in space.
space::Drop in_space(const PreparedScene& prepared) {
  if (const auto* const drop = std::get_if<space::Drop>(&prepared.drop)) return *drop;
  return space_drop(prepared.scene, space::outline(std::get<analytic::Drop>(prepared.drop).body));
}

/// Follows the motion, whatever the number of impacts asked for, and notes where it is at the times asked for.
void add_states(const PreparedScene& prepared, Run& run) {
  const Scene& scene = prepared.scene;
  if (!scene.has_times()) return;
  const std::vector<double> times = state_times(scene, run);
  const analytic::SequenceOptions options{
      .impacts = 1'000'000, .digits = scene.accuracy.digits, .until_rest = true, .until = times.back()};
  for (const space::StateAt& state : impact_sequence(in_space(prepared), options, times).states)
    run.states.push_back(motion_at(state));
}

}  // namespace

DiscreteRun run_discrete(const PreparedScene& prepared) {
  const Scene& scene = prepared.scene;
  const analytic::SequenceOptions options = sequence_options(scene);
  DiscreteSequence sequence =
      std::visit([&](const auto& drop) -> DiscreteSequence { return impact_sequence(drop, options); }, prepared.drop);
  Run run = named_run(scene, sequence, prepared.centre);
  if (const auto* const planar = std::get_if<analytic::Drop>(&prepared.drop); planar && planar->fall)
    run.first_touch = first_touch_of(*planar);
  add_states(prepared, run);
  return {std::move(sequence), std::move(run)};
}

}  // namespace clatter::validation
