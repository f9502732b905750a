// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/keys.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "validation/output/bad_input.hpp"
#include "validation/output/json.hpp"
#include "validation/output/report.hpp"
#include "validation/scene/floors.hpp"
#include "validation/scene/orientation.hpp"

namespace clatter::validation {
namespace {

constexpr long long most = 100'000;  // elements along an edge of a mesh
constexpr Range finite{-largest_number, largest_number, false, "finite"};
constexpr Range sizes{1e-100, 1e100, false, "from 1e-100 to 1e100"};
constexpr Range radii{0, 1e100, false, "from 0 to 1e100"};
constexpr Range masses{1e-100, 1e100, false, "from 1e-100 to 1e100"};
// The discrete model scales its units: only squares of lengths must not overflow.
constexpr Range wide_sizes{1e-150, 1e150, false, "from 1e-150 to 1e150"};
constexpr Range wide_radii{0, 1e150, false, "from 0 to 1e150"};
constexpr Range wide_masses{1e-200, 1e200, false, "from 1e-200 to 1e200"};
constexpr Range speeds{0, 1e9, true, "greater than 0 and at most 1e9"};
constexpr Range velocities{-1e9, 1e9, false, "from -1e9 to 1e9"};
constexpr Range gravities{0, 1e9, false, "from 0 to 1e9"};
constexpr Range slopes{-89, 89, false, "from -89 to 89 degrees"};
constexpr Range heights{0, 1e12, true, "greater than 0 and at most 1e12"};
constexpr Range angles{0, 90, false, "from 0 to 90 degrees"};
constexpr Range turns_of_release{-1e4, 1e4, false, "from -1e4 to 1e4 degrees"};
constexpr Range tilts{-180, 180, false, "from -180 to 180 degrees"};
constexpr Range parameters{-1.01, 1.01, false, "from -1.01 to 1.01"};
constexpr Range orientations{1, orientation_count, false, "a whole number from 1 to 26"};
constexpr Range restitutions{0, 1, false, "from 0 to 1"};
constexpr Range losses_allowed{0, 1, true, "greater than 0 and at most 1"};
constexpr Range file_units{0, 1e100, true, "mm, cm, m, in, or a length in m greater than 0 and at most 1e100"};
constexpr Range welds{0, 0.1, false, "from 0 to 0.1"};
constexpr Range tolerances{numeric::least_tolerance, 0.1, false, "from 5e-14 to 0.1"};

// The kinds of values, each by the members that lead to its place in a scene.

using Kind = KeyValue::Kind;

template <auto... path>
auto& at(auto& scene) {
  return (scene.*....*path);
}

/// The member is a double, or an optional one.
/// @param wide  for the discrete model, where it allows more
template <auto... path>
KeyValue number(const Range& range, const Range* wide = nullptr) {
  const auto get = [](const Scene& scene) -> Value {
    const auto& held = at<path...>(scene);
    if constexpr (requires { held.has_value(); }) return held ? Value(*held) : Value();
    else return held;
  };
  const auto read = [range, wide](const SceneValues& values, const std::string& name, Scene& scene, Model model) {
    at<path...>(scene) = values.number(name, 0, wide && model == Model::discrete ? *wide : range);
  };
  return {.kind = Kind::number,
          .allowed = range.words + (wide ? fmt::format("; discrete model: {}", wide->words) : ""),
          .get = get,
          .read = read,
          .put = [](Scene& scene, double number) { at<path...>(scene) = number; },
          .range = range};
}

bool is_negative(const SceneValues& values, const std::string& name) {
  try {
    return values.number(name, 0, any_number) < 0;
  } catch (const BadInput&) {
    return false;
  }
}

/// One end is low at the first impact; whose other end is to be so is told how.
KeyValue first_angle() {
  KeyValue value = number<&Scene::angle_deg>(angles);
  value.read = [read = value.read](const SceneValues& values, const std::string& name, Scene& scene, Model model) {
    try {
      read(values, name, scene, model);
    } catch (const BadInput& refusal) {
      if (!is_negative(values, name)) throw;
      throw BadInput(
          "{}: end a (-x) is low; the other one is with a negative --release-angle, which needs "
          "--release-height or --release-clearance",
          refusal.what());
    }
  };
  return value;
}

struct Wholes {
  long long low, high;
};

/// The member is an int or a long.
template <auto... path>
KeyValue whole(const Wholes& range, const std::optional<Wholes>& wide = {}) {
  const auto put = [](Scene& scene, auto number) {
    auto& held = at<path...>(scene);
    held = static_cast<std::remove_reference_t<decltype(held)>>(number);
  };
  const auto read = [=](const SceneValues& values, const std::string& name, Scene& scene, Model model) {
    const Wholes& allowed = wide && model == Model::discrete ? *wide : range;
    put(scene, values.integer(name, 0, allowed.low, allowed.high));
  };
  return {.kind = Kind::whole,
          .allowed = fmt::format("a whole number from {} to {}", range.low, range.high) +
                     (wide ? fmt::format("; discrete model: from {} to {}", wide->low, wide->high) : ""),
          .get = [](const Scene& scene) { return Value(at<path...>(scene)); },
          .read = read,
          .put = put};
}

/// A truth or a text.
template <auto... path>
KeyValue plain() {
  constexpr bool is_truth = std::is_same_v<decltype(at<path...>(std::declval<Scene&>())), bool&>;
  const auto read = [](const SceneValues& values, const std::string& name, Scene& scene, Model) {
    if constexpr (is_truth) at<path...>(scene) = values.truth(name, false);
    else at<path...>(scene) = values.text(name);
  };
  return {.kind = is_truth ? Kind::truth : Kind::text,
          .allowed = is_truth ? "true or false" : "a text",
          .get = [](const Scene& scene) { return Value(at<path...>(scene)); },
          .read = read,
          .example = is_truth ? "true" : "\"name\""};
}

/// The member is an enumeration, a truth or a number of the name, or an optional one, of which the first name is told.
template <auto... path>
KeyValue choice(const std::vector<std::string>& names) {
  const auto get = [names](const Scene& scene) {
    const auto& held = at<path...>(scene);
    if constexpr (requires { held.has_value(); }) return Value(names[held ? static_cast<std::size_t>(*held) : 0]);
    else return Value(names[static_cast<std::size_t>(held)]);
  };
  const auto read = [names](const SceneValues& values, const std::string& name, Scene& scene, Model) {
    auto& held = at<path...>(scene);
    using Held = std::remove_reference_t<decltype(held)>;
    const std::size_t index = values.name(name, 0, names);
    if constexpr (requires { held.has_value(); }) held = static_cast<typename Held::value_type>(index);
    else held = static_cast<Held>(index);
  };
  return {.kind = Kind::name,
          .allowed = fmt::format("one of {}", fmt::join(names, ", ")),
          .get = get,
          .read = read,
          .names = names,
          .example = fmt::format("\"{}\"", names.front())};
}

/// The member is a list, or a vector of three.
/// @param counts  how many numbers; empty: one or more.  @param words  what is allowed
template <auto... path>
KeyValue list(const std::vector<std::size_t>& counts, const Range& range, const char* words, const char* example,
              const Range* wide = nullptr) {
  const auto get = [](const Scene& scene) {
    const auto& held = at<path...>(scene);
    return held.size() == 0 ? Value() : Value(held);
  };
  const auto read = [=](const SceneValues& values, const std::string& name, Scene& scene, Model model) {
    auto& held = at<path...>(scene);
    const std::vector<double> numbers =
        values.numbers(name, counts, wide && model == Model::discrete ? *wide : range, words);
    if constexpr (requires { held = numbers; }) held = numbers;
    else std::copy(numbers.begin(), numbers.end(), held.begin());
  };
  return {.kind = Kind::list, .allowed = words, .get = get, .read = read, .range = range, .example = example};
}

template <auto... path>
KeyValue velocities_of(const char* example) {
  return list<path...>({3}, velocities, "three numbers from -1e9 to 1e9", example, &finite);
}

template <auto... path>
KeyValue euler_parameters() {
  return list<path...>({4}, parameters, "four numbers q0, q1, q2, q3 of length 1 (normalised if within 0.01 of it)",
                       "[1, 0, 0, 0]");
}

/// A list of pairs, or the file that has them.
KeyValue curve(const char* words, const char* example) {
  const auto get = [](const Scene& scene) {
    Value list;
    for (const auto& [x, y] : scene.pad.curve) list.push_back(Value::List{x, y});
    return list;
  };
  const auto read = [words](const SceneValues& values, const std::string& name, Scene& scene, Model) {
    if (const auto points = values.pairs(name, words)) scene.pad.curve = *points;
    else scene.pad.file = values.file(name);
  };
  return {.kind = Kind::curve, .allowed = words, .get = get, .read = read, .example = example};
}

// How keys stand in the echo.

Echo null_if(bool none) { return none ? Echo::null : Echo::value; }
Echo only_if(bool shown) { return shown ? Echo::value : Echo::absent; }
/// Whether a scene has something else there than one of which nothing is said.
template <auto... path>
bool is_said(const Scene& scene) {
  static const Scene silent;
  return at<path...>(scene) != at<path...>(silent);
}
template <auto... path>
Echo if_said(const Scene& scene, Model) {
  return only_if(is_said<path...>(scene));
}
template <auto... path>
Echo null_unless_said(const Scene& scene, Model) {
  return null_if(!is_said<path...>(scene));
}
/// Nothing there is null for the continuous model, to which all keys are shown.
Echo in_discrete_only_if(bool given, Model model) { return only_if(given || model == Model::continuous); }
template <BodyScene::Shape shape>
Echo of_shape(const Scene& scene, Model) {
  return only_if(scene.body.shape == shape);
}
template <auto has>
Echo of_body_that(const Scene& scene, Model) {
  return only_if((scene.body.*has)());
}
Echo of_sectors(const Scene& scene, Model) {
  return only_if(scene.body.shape == BodyScene::Shape::rod || (scene.body.is_round() && !scene.body.is_smooth()));
}
Echo of_release(const Scene& scene, Model) { return only_if(scene.is_released()); }
/// An impulse ratio of 0 says that there is no friction.
Echo of_impulse_ratio(const Scene& scene, Model model) {
  const bool has_other = scene.impact.friction || takes_friction_of_ground(scene);
  return in_discrete_only_if(scene.impact.impulse_ratio || !has_other, model);
}
/// The discrete model has no use for keys of a ground that is not there.
Echo of_ground(const Scene& scene, Model model) { return only_if(model == Model::continuous || scene.has_ground()); }
Echo of_pad(const Scene& scene, Model) { return only_if(scene.world.ground.is_pad()); }
Echo of_springs(const Scene& scene, Model model) {
  return scene.world.ground.has_dissipation() || scene.ground_restitution ? Echo::absent : of_ground(scene, model);
}
Echo of_area(const Scene& scene, Model model) {
  return scene.world.ground.is_half_space() || scene.half_space.floor ? Echo::absent : of_ground(scene, model);
}

std::vector<Key> made_keys() {
  using enum Use;
  using numeric::Accuracy, numeric::Ground, numeric::Request, numeric::World;
  using Keys = std::vector<const char*>;
  // Keys whose place another takes.
  const Keys turns{"drop.angle_deg", "drop.tilt_deg"}, ways_to_turn{"drop.angle_deg", "drop.tilt_deg", "drop.attitude"};
  const Keys before_release{"drop.speed",    "drop.height", "drop.clearance",        "drop.tangential_velocity",
                            "drop.velocity", "drop.spin",   "drop.angular_velocity", "drop.topple"};
  const auto and_also = [](Keys keys, const char* other) {
    keys.push_back(other);
    return keys;
  };
  const Keys attitudes{"drop.angle_deg", "drop.tilt_deg", "drop.attitude", "drop.orientation"};
  const Keys springs{"ground.stiffness", "ground.damping"};
  const Keys springs_and_area = and_also(springs, "ground.area"),
             springs_and_half_space = and_also(springs, "ground.modulus");
  return {
      {"drop.angle_deg", both, "--angle", "DEG", "°",
       "inclination at the first impact, end a (-x) low; 0 flat, 90 upright", first_angle(), nullptr, Keys{}, true},
      {"drop.tilt_deg", both, "--tilt", "DEG", "°", "rotation about the body's long axis before that",
       number<&Scene::tilt_deg>(tilts)},
      {"drop.attitude", both, "--attitude", "Q0,Q1,Q2,Q3", "",
       "or Euler parameters, body to world, scalar first; the lowest vertex is put on the ground",
       euler_parameters<&Scene::attitude>(), nullptr, turns},
      {"drop.orientation", both, "--orientation", "N", "",
       "or which part of a box points down: 1-6 faces, 7-18 edges, 19-26 corners",
       number<&Scene::orientation>(orientations), nullptr, ways_to_turn},
      {"drop.start", continuous, "--start", "", "",
       "begins with the first touch, or at rest on the ground, as deep as its weight presses it",
       choice<&Scene::request, &Request::starts_on_ground>({"touch", "rest"}),
       if_said<&Scene::request, &Request::starts_on_ground>},
      {"drop.speed", both, "--speed", "M/S", "m/s", "downward, of the centre of mass at first touch",
       number<&Scene::speed>(speeds, &positive_number),
       [](const Scene& s, Model model) {
         return null_if(!s.velocity.empty() || s.request.starts_on_ground || (s.falls() && model == Model::continuous));
       }},
      {"drop.height", both, "--height", "M", "m", "or its height at release from rest",
       number<&Scene::height>(heights, &positive_number), nullptr, Keys{"drop.speed"}},
      {"drop.clearance", both, "--clearance", "M", "m",
       "or that of its lowest point at release from rest, the drop height of test standards",
       number<&Scene::clearance>(heights, &positive_number), nullptr, Keys{"drop.speed", "drop.height"}},
      {"drop.tangential_velocity", both, "--tangential-velocity", "M/S", "m/s", "of the centre of mass, to the right",
       number<&Scene::tangential_velocity>(velocities, &finite)},
      {"drop.velocity", both, "--velocity", "X,Y,Z", "m/s",
       "or all of it: of the centre of mass at the first touch, world", velocities_of<&Scene::velocity>("[0, 0, -1]"),
       nullptr, Keys{"drop.speed", "drop.height", "drop.clearance", "drop.tangential_velocity"}},
      {"drop.spin", both, "--spin", "RAD/S", "rad/s", "clockwise, as Omega in Eq. 8",
       number<&Scene::spin>(velocities, &finite)},
      {"drop.angular_velocity", both, "--angular-velocity", "X,Y,Z", "rad/s",
       "or all of it: at the first touch, world components", velocities_of<&Scene::angular_velocity>("[0, 0, 0]"),
       nullptr, Keys{"drop.spin"}},
      {"drop.topple", both, "--topple", "M", "m",
       "or let go from rest, end a raised by this: it turns about the lower edge of end b and lands flat",
       number<&Scene::topple>(heights, &positive_number), nullptr,
       Keys(before_release.begin(), before_release.end() - 1)},
      {"drop.release.height", both, "--release-height", "M", "m",
       "or let it fly freely, turning, to its first touch, from this height of the centre of mass",
       number<&Scene::release, &Release::height>(heights, &positive_number), of_release, before_release},
      {"drop.release.clearance", both, "--release-clearance", "M", "m", "or from this one of its lowest point",
       number<&Scene::release, &Release::clearance>(heights, &positive_number), of_release,
       and_also(before_release, "drop.release.height")},
      {"drop.release.angle_deg", both, "--release-angle", "DEG", "°",
       "inclination at the release, end a low where positive; without it the angle, attitude or orientation above",
       number<&Scene::release, &Release::angle_deg>(turns_of_release), of_release, attitudes},
      {"drop.release.attitude", both, "--release-attitude", "Q0,Q1,Q2,Q3", "", "or Euler parameters",
       euler_parameters<&Scene::release, &Release::attitude>(), of_release,
       and_also(attitudes, "drop.release.angle_deg")},
      {"drop.release.velocity", both, "--release-velocity", "X,Y,Z", "m/s",
       "of the centre of mass at the release, world; without it at rest",
       velocities_of<&Scene::release, &Release::velocity>("[0, 0, 0]"), of_release},
      {"drop.release.spin", both, "--release-spin", "RAD/S", "rad/s",
       "at the release, clockwise, as Omega in Eq. 8; without it none",
       number<&Scene::release, &Release::spin>(velocities), of_release},
      {"drop.release.angular_velocity", both, "--release-angular-velocity", "X,Y,Z", "rad/s",
       "or all of it, world components", velocities_of<&Scene::release, &Release::angular_velocity>("[0, 0, 0]"),
       of_release, Keys{"drop.release.spin"}},
      {"world.gravity", both, "--gravity", "M/S2", "m/s²",
       "acceleration of free fall; 9.81 where a height, clearance, topple, release or incline is given, else 0",
       number<&Scene::world, &World::gravity>(gravities, &not_negative_number)},
      {"world.incline_deg", both, "--incline", "DEG", "°",
       "slope of the ground, down to the right where positive; x and z are along and across the ground",
       number<&Scene::world, &World::incline_deg>(slopes), if_said<&Scene::world, &World::incline_deg>},
      {"impact.restitution", both, "--restitution", "E", "",
       "coefficient of the discrete model; without it from the ground's damping, or 1 without a ground",
       number<&Scene::impact, &DiscreteImpact::restitution>(restitutions),
       [](const Scene& s, Model) { return null_if(restitution_law(s) == analytic::RestitutionLaw::viscoelastic); }},
      {"impact.law", both, "--restitution-law", "", "",
       "what the coefficient relates; viscoelastic: it follows from the ground's damping and the approach speed, as "
       "it does where a ground and no restitution is given",
       choice<&Scene::impact, &DiscreteImpact::law>(law_names())},
      {"impact.impulse_ratio", both, "--impulse-ratio", "MU_I", "", "Eq. 8's ratio of tangential to normal impulse",
       number<&Scene::impact, &DiscreteImpact::impulse_ratio>(finite), of_impulse_ratio},
      {"impact.friction", both, "--friction", "MU", "",
       "or Coulomb's coefficient of friction; without either the ground's sliding_friction",
       number<&Scene::impact, &DiscreteImpact::friction>(not_negative_number),
       [](const Scene& s, Model model) { return in_discrete_only_if(s.impact.friction.has_value(), model); }},
      {"impact.friction_law", both, "--impact-friction-law", "", "",
       "coulomb: against the slip at every instant of the impact; moreau: against that after it, as time-steppers "
       "have it, with newton's restitution",
       choice<&Scene::impact, &DiscreteImpact::is_moreau>({"coulomb", "moreau"}),
       if_said<&Scene::impact, &DiscreteImpact::is_moreau>},
      {"body.shape", both, "--body", "", "", "shape of what falls; a rod with a radius is a cylinder",
       choice<&Scene::body, &BodyScene::shape>(shape_names())},
      {"body.mass", both, "--mass", "KG", "kg", "mass", number<&Scene::body, &BodyScene::mass>(masses, &wide_masses)},
      {"body.length", both, "--length", "M", "m", "of the rod; of the capsule over all",
       number<&Scene::body, &BodyScene::length>(sizes, &wide_sizes), of_body_that<&BodyScene::has_length>},
      {"body.radius", both, "--radius", "M", "m", "of the rod, sphere or capsule",
       number<&Scene::body, &BodyScene::radius>(radii, &wide_radii), of_body_that<&BodyScene::has_radius>},
      {"body.size", both, "--size", "LxWxT", "m",
       "of the box or ellipsoid, whole axes in m, as 0.15x0.075x0.008: along the inclination, across, upright at 0 "
       "degrees",
       list<&Scene::body, &BodyScene::size>({3}, sizes,
                                            "three lengths in m greater than 0, as in [0.106, 0.044, 0.019]",
                                            "[0.106, 0.044, 0.019]", &wide_sizes),
       of_body_that<&BodyScene::has_size>},
      {"body.mesh.sectors", continuous, "", "N", "",
       "elements around the x axis of what is round; a rod has 16 without it, or 64 where its radius is above a "
       "twentieth of its length; a sphere, ellipsoid or capsule is a mesh, and no more smooth, where it is given",
       whole<&Scene::body, &BodyScene::sectors>({3, most}), of_sectors},
      {"body.mesh.rings", continuous, "", "N", "",
       "from a rod's axis outward, 4 without it; else from each pole to the equator, as with the sectors",
       whole<&Scene::body, &BodyScene::rings>({1, most}), of_sectors},
      {"body.mesh.layers", continuous, "", "N", "", "along it", whole<&Scene::body, &BodyScene::layers>({1, most}),
       of_shape<BodyScene::Shape::rod>},
      {"body.mesh.nx", continuous, "", "N", "", "elements along the box",
       whole<&Scene::body, &BodyScene::nx>({1, most}), of_shape<BodyScene::Shape::box>},
      {"body.mesh.ny", continuous, "", "N", "", "across it", whole<&Scene::body, &BodyScene::ny>({1, most}),
       of_shape<BodyScene::Shape::box>},
      {"body.mesh.nz", continuous, "", "N", "", "through its thickness", whole<&Scene::body, &BodyScene::nz>({1, most}),
       of_shape<BodyScene::Shape::box>},
      {"body.mesh.file", both, "--mesh", "FILE", "",
       "a mesh as the body: STL, OBJ, PLY, OFF, glTF, 3MF or COLLADA, closed but for small faults; Gmsh's .msh and "
       ".geo, STEP",
       plain<&Scene::body, &BodyScene::file>(), of_shape<BodyScene::Shape::mesh>},
      {"body.mesh.unit", both, "--unit", "M", "m",
       "of the mesh file's coordinates; without it what the file names, else m",
       number<&Scene::body, &BodyScene::unit>(file_units), of_shape<BodyScene::Shape::mesh>},
      {"body.mesh.weld", both, "", "X", "",
       "corners at gaps that are closer than this are one, of the largest extent; 0: only equal ones",
       number<&Scene::body, &BodyScene::weld>(welds), of_shape<BodyScene::Shape::mesh>},
      {"body.mesh.strict", both, "", "true|false", "", "a mesh that needs repair is refused",
       plain<&Scene::body, &BodyScene::strict>(), of_shape<BodyScene::Shape::mesh>},
      {"body.mesh.density", both, "", "KG/M3", "kg/m³", "of a file's body, or body.mass",
       number<&Scene::body, &BodyScene::density>(positive_number), if_said<&Scene::body, &BodyScene::density>,
       Keys{"body.mass"}},
      {"body.inertia", both, "--inertia", "LIST", "kg m²",
       "about the centre of mass, principal or xx, yy, zz, xy, xz, yz in body axes; without it the uniform "
       "body's about its own centre",
       list<&Scene::body, &BodyScene::inertia>(
           {3, 6}, finite, "three principal moments in kg m2, or six numbers xx, yy, zz, xy, xz, yz", "[1, 1, 1]")},
      {"body.centre", both, "--centre", "X,Y,Z", "m",
       "of mass, from the geometric centre, of a mesh in its file's frame and unit; without "
       "it that of the enclosed volume",
       list<&Scene::body, &BodyScene::centre>({3}, finite, "three coordinates in m, of a mesh in its file's unit",
                                              "[0, 0, 0]")},
      {"body.merge", continuous, "", "true|false", "", "coplanar elements become one facet",
       plain<&Scene::body, &BodyScene::merge>()},
      {"ground.stiffness", both, "--stiffness", "N/M3", "N/m³",
       "k_G, pressure of the ground for each metre of depth; clatter shock --ground finds it; or ground.modulus, "
       "ground.floor or ground.curve",
       number<&Scene::world, &World::ground, &Ground::stiffness>(positive_number),
       [](const Scene& s, Model model) {
         if (s.world.ground.has_dissipation()) return Echo::absent;
         return s.has_ground() ? Echo::value : model == Model::continuous ? Echo::null : Echo::absent;
       },
       Keys{}, true},
      {"ground.damping", both, "--damping", "N.S/M4", "N·s/m⁴", "c_G, the same for each m/s at which the depth grows",
       number<&Scene::world, &World::ground, &Ground::damping>(not_negative_number), of_springs},
      {"ground.modulus", both, "--ground-modulus", "PA", "Pa",
       "E* of an elastic half-space, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 of ground and body: it is harder under "
       "small patches than under large ones",
       number<&Scene::half_space, &HalfSpaceScene::modulus>(positive_number),
       if_said<&Scene::half_space, &HalfSpaceScene::modulus>, springs_and_area},
      {"ground.floor", both, "--floor", "", "",
       "or a named floor, a half-space of published numbers (clatter shock --ground shows them) under a body of "
       "ground.body_material; with ground.curve what is under the pad where it bottoms out",
       choice<&Scene::half_space, &HalfSpaceScene::floor>(floor_names()),
       if_said<&Scene::half_space, &HalfSpaceScene::floor>,
       Keys{"ground.stiffness", "ground.damping", "ground.area", "ground.modulus", "ground.under"}},
      {"ground.body_modulus", both, "--body-modulus", "PA", "Pa",
       "E/(1 - nu^2) of the body on a half-space, whose modulus is then the ground's alone",
       number<&Scene::half_space, &HalfSpaceScene::body_modulus>(positive_number),
       if_said<&Scene::half_space, &HalfSpaceScene::body_modulus>,
       Keys{"ground.stiffness", "ground.damping", "ground.area", "ground.curve", "ground.curve_units",
            "ground.thickness", "ground.under", "ground.body_material"}},
      {"ground.body_material", both, "--body-material", "NAME", "",
       "or what the body is made of: abs, steel, glass and others of clatter help keys; on a named floor abs "
       "without it",
       choice<&Scene::half_space, &HalfSpaceScene::body_material>(body_material_names()),
       [](const Scene& s, Model) {
         return only_if(s.half_space.body_material || (s.half_space.floor && !s.half_space.body_modulus));
       },
       springs_and_area},
      {"ground.dissipation", both, "--dissipation", "S/M", "s/m",
       "of a half-space or a pad: Hunt and Crossley's factor on its pressure, 1 + dissipation times the speed at "
       "which the depth grows",
       number<&Scene::world, &World::ground, &Ground::dissipation>(not_negative_number),
       [](const Scene& s, Model) { return only_if(s.world.ground.has_dissipation() && !s.ground_restitution); },
       springs},
      {"ground.restitution", both, "--floor-restitution", "E", "",
       "or the restitution of the first impact, from whose approach speed damping or dissipation follow (exact of a "
       "flat or upright landing without friction)",
       number<&Scene::ground_restitution>(losses_allowed), if_said<&Scene::ground_restitution>,
       Keys{"ground.damping", "ground.dissipation"}},
      {"ground.curve", both, "--curve", "CURVE", "",
       "or a pad by what its data sheet has: strain (with ground.thickness) or depth, and pressure, straight "
       "between the points and from 0, 0 to the first",
       curve("a CSV file whose header states units, or two or more points [[x, pressure], ...], x strain or m, "
             "pressure in Pa, neither of which falls",
             "[[0, 0], [0.1, 2e4], [0.6, 5e4]]"),
       of_pad, springs_and_half_space},
      {"ground.curve_units", both, "--curve-units", "X,P", "",
       "of the curve's two columns, as %,kPa; without it those of a file's header, or m, or 1 with a thickness, and "
       "Pa",
       plain<&Scene::pad, &PadScene::units>(), of_pad, springs_and_half_space},
      {"ground.thickness", both, "--thickness", "M", "m",
       "of the pad, by which strain becomes depth; under springs it warns of impacts too deep for them; in clatter "
       "shock --ground of a layer",
       number<&Scene::pad, &PadScene::thickness>(positive_number),
       [](const Scene& s, Model) { return only_if(s.world.ground.is_pad() || s.pad.thickness); },
       Keys{"ground.modulus"}},
      {"ground.under", both, "--under", "PA/M", "Pa/m",
       "stiffness of the pad beyond its curve's last point, where it bottoms out; without it or ground.floor that "
       "before the point",
       number<&Scene::pad, &PadScene::under>(positive_number), of_pad, springs_and_half_space},
      {"ground.static_friction", both, "--static-friction", "MU", "", "of the ground; without it sliding_friction",
       number<&Scene::world, &World::ground, &Ground::static_friction>(not_negative_number), of_ground},
      {"ground.sliding_friction", both, "--sliding-friction", "MU", "", "of the ground; without it static_friction",
       number<&Scene::world, &World::ground, &Ground::sliding_friction>(not_negative_number), of_ground},
      {"ground.area", both, "--area", "", "", "area over which the load is integrated; of a pad projected without it",
       choice<&Scene::world, &World::ground, &Ground::area>(area_names()), of_area},
      {"ground.friction_law", both, "", "NAME", "", "what friction does where the face slips unevenly",
       choice<&Scene::world, &World::ground, &Ground::friction>({"coulomb", "regularised", "local"}), of_ground},
      {"ground.regularisation_speed", both, "", "M/S", "m/s", "v_r of the regularised law",
       number<&Scene::world, &World::ground, &Ground::regularisation_speed>(positive_number), of_ground},
      {"run.impacts", both, "--impacts", "N", "", "most impacts to report",
       whole<&Scene::request, &Request::impacts>({1, 1'000'000})},
      {"run.until_rest", discrete, "--until-rest", "", "",
       "discrete model: go on until the body rests, or no impact follows, for 100000 impacts at most; exit status 3 "
       "if that is not enough",
       plain<&Scene::until_rest>(), if_said<&Scene::until_rest>},
      {"run.until", both, "--until", "S", "s",
       "the run ends at this time since the first impact; 100000 impacts at most",
       number<&Scene::request, &Request::until>(positive_number), if_said<&Scene::request, &Request::until>},
      {"run.at", both, "--at", "T,...", "s",
       "times since the first impact at which the state is printed, too, with its errors",
       list<&Scene::times>({}, finite, "times in s", "[0.1, 0.5]"), if_said<&Scene::times>},
      {"run.rate", both, "--rate", "HZ", "Hz",
       "the same at equal steps from the first impact to run.until, or to the last impact",
       number<&Scene::rate>(positive_number), if_said<&Scene::rate>},
      {"run.digits", both, "--digits", "N", "", "significant digits asked for",
       whole<&Scene::accuracy, &Accuracy::digits>({2, 12}, Wholes{1, 15})},
      {"run.require_digits", both, "--require-digits", "", "", "exit status 3 if fewer digits are known",
       plain<&Scene::require_digits>()},
      {"run.method", continuous, "--method", "NAME", "", "auto, tvd-rk3, rk4, rkf45, rkck or rk8pd",
       choice<&Scene::accuracy, &Accuracy::method>(method_names())},
      {"run.tolerance", continuous, "--tolerance", "TOL", "", "local error per step of an adaptive method",
       number<&Scene::accuracy, &Accuracy::tolerance>(tolerances),
       null_unless_said<&Scene::accuracy, &Accuracy::tolerance>},
      {"run.step", continuous, "--step", "S", "s", "of tvd-rk3",
       number<&Scene::accuracy, &Accuracy::step>(positive_number), null_unless_said<&Scene::accuracy, &Accuracy::step>},
      {"run.history", continuous, "--history", "FILE", "", "time history as CSV", plain<&Scene::history>(),
       null_unless_said<&Scene::history>},
      {"run.planar", continuous, "--planar", "", "", "keep the motion in its plane",
       plain<&Scene::world, &World::planar>()},
      {"run.contact_gravity", continuous, "--no-contact-gravity", "", "",
       "whether gravity acts during contacts too; with the flag it acts in flight only",
       plain<&Scene::world, &World::gravity_in_contact>()},
      {"run.evaluation_limit", continuous, "", "N", "", "of the contact forces; then the run ends with the rows so far",
       whole<&Scene::accuracy, &Accuracy::evaluation_limit>({1, 1'000'000'000'000})},
      {"run.errors", continuous, "", "true|false", "",
       "errors by a finer run, which costs more than the run itself; false leaves them out",
       plain<&Scene::request, &Request::error_estimates>()},
      {"run.amplification", continuous, "", "true|false", "",
       "their growth by a neighbouring run, a quarter of the run itself; false leaves it out",
       plain<&Scene::request, &Request::amplification>()},
      {"run.note_local_slip", continuous, "--note-local-slip", "", "",
       "estimate what each place's own slip would change, however little; else only with run.errors, where it may "
       "matter",
       plain<&Scene::request, &Request::local_slip>()},
  };
}

}  // namespace

const std::vector<Key>& all_keys() {
  static const std::vector<Key> keys = made_keys();
  return keys;
}

namespace {

/// Puts in what the models take without being told.
void settle_defaults(Scene& scene) {
  if (!scene.body.is_smooth()) {
    scene.body.sectors = scene.body.meshed_sectors();
    scene.body.rings = scene.body.meshed_rings();
  }
  scene.impact.law = restitution_law(scene);
  if (!scene.impact.restitution) scene.impact.restitution = 1;
}

Echo echo_of(const Key& key, const Scene& scene, Model model) {
  if (key.echo) return key.echo(scene, model);
  return null_if(std::ranges::any_of(alternatives(), [&](const Alternative& pair) {
    return std::string_view(pair.instead_of) == key.name && key_named(pair.key).is_given(scene);
  }));
}

}  // namespace

const std::vector<std::string>& area_names() {
  static const std::vector<std::string> names{"surface", "projected"};
  return names;
}

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names{"auto", "tvd-rk3", "rk4", "rkf45", "rkck", "rk8pd"};
  return names;
}

const std::vector<std::string>& sweep_names() {
  static const std::vector<std::string> names{"angle_deg", "sliding_friction"};
  return names;
}

Value Key::get(const Scene& scene) const {
  if (echo_of(*this, scene, Model::continuous) != Echo::value) return {};
  Scene shown = scene;
  settle_defaults(shown);
  return value.get(shown);
}

std::string Key::value_type() const { return *type == '\0' ? fmt::format("{}", fmt::join(value.names, "|")) : type; }

std::string Key::argument() const {
  std::string name_ = flag;
  if (name_.empty() || name_.starts_with("--no-")) return std::string(name).substr(std::string(name).rfind('.') + 1);
  name_.erase(0, 2);
  std::replace(name_.begin(), name_.end(), '-', '_');
  return name_;
}

bool Key::is_of_times() const {
  const std::string_view key = name;
  return key == "run.until" || key == "run.at" || key == "run.rate";
}

const Key& key_named(std::string_view name) {
  const auto found =
      std::find_if(all_keys().begin(), all_keys().end(), [&](const Key& key) { return key.name == name; });
  if (found == all_keys().end()) throw std::out_of_range("no key " + std::string(name));
  return *found;
}

const std::vector<Alternative>& alternatives() {
  static const std::vector<Alternative> pairs = [] {
    std::vector<Alternative> list;
    for (const Key& key : all_keys()) {
      for (const char* other : key.instead_of) list.push_back({key.name, other});
    }
    return list;
  }();
  return pairs;
}

bool are_alternatives(std::string_view one, std::string_view other) {
  const auto& pairs = alternatives();
  return std::any_of(pairs.begin(), pairs.end(), [&](const Alternative& pair) {
    return (pair.key == one && pair.instead_of == other) || (pair.key == other && pair.instead_of == one);
  });
}

const std::vector<std::string>& scene_keys() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Key& key : all_keys()) list.emplace_back(key.name);
    for (const std::string& swept : sweep_names()) {
      for (const char* part : {"", ".from", ".to", ".step", ".count", ".scale"})
        list.push_back("sweep." + swept + part);
    }
    return list;
  }();
  return names;
}

const std::map<std::string, std::string>& key_flags() {
  static const std::map<std::string, std::string> flags = [] {
    std::map<std::string, std::string> by_key;
    for (const Key& key : all_keys()) {
      if (*key.flag != '\0') by_key.emplace(key.name, key.flag);
    }
    return by_key;
  }();
  return flags;
}

std::string flag_words(const std::vector<SceneOverride>& overrides) {
  std::string words;
  for (const SceneOverride& given : overrides) {
    const Key& key = key_named(given.key);
    const std::string flag = key.flag;
    if (flag.empty() || (key.is_truth() && (given.text == "false") != flag.starts_with("--no-"))) continue;
    words += " " + flag + (key.is_truth() ? "" : " " + shell_word(given.text));
  }
  return words;
}

void put_values(const SceneValues& values, Scene& scene, Model model) {
  for (const Key& key : all_keys()) {
    if (values.has(key.name)) key.value.read(values, key.name, scene, model);
  }
}

void add_keys(const Scene& scene, Model model, Value& fields) {
  Scene shown = scene;
  // What the discrete model takes without being told: no friction is a ratio of 0.
  if (model == Model::discrete && !shown.impact.impulse_ratio) shown.impact.impulse_ratio = 0;
  settle_defaults(shown);
  for (const Key& key : all_keys()) {
    if (!key.is_for(model)) continue;
    const Echo echo = echo_of(key, scene, model);
    if (echo == Echo::absent) continue;
    Value* place = &fields;
    std::string name = key.name;
    for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.')) {
      place = &(*place)[name.substr(0, dot)];
      name.erase(0, dot + 1);
    }
    (*place)[name] = echo == Echo::null ? Value() : key.value.get(shown);
  }
}

Scene bare_scene(BodyScene::Shape shape) {
  Scene scene;
  scene.body.shape = shape;
  scene.world.ground.stiffness = 0;
  scene.world.gravity = 0;
  return scene;
}

namespace {

bool is_always_said(const Key& key) {
  constexpr std::array names{"body.shape", "body.mass",     "body.length",       "body.radius",
                             "body.size",  "world.gravity", "impact.restitution"};
  return key.is_required || std::find(names.begin(), names.end(), std::string_view(key.name)) != names.end();
}

}  // namespace

std::vector<const Key*> said_keys(const Scene& scene) {
  const Scene bare = bare_scene(scene.body.shape);
  std::vector<const Key*> said;
  for (const Key& key : all_keys()) {
    const Value value = key.get(scene);
    if (key.is_file() || value.is_nothing()) continue;
    if (is_always_said(key) || compact_json(value) != compact_json(key.get(bare))) said.push_back(&key);
  }
  return said;
}

std::string scene_text(const std::string& head, const std::vector<const Key*>& keys,
                       const std::function<std::string(const Key& key, const std::string& name)>& line) {
  std::string text = head + "\n", table;
  for (const Key* key : keys) {
    const std::string name = key->name;
    const std::size_t dot = name.find('.');
    if (name.substr(0, dot) != table) text += fmt::format("\n[{}]\n", table = name.substr(0, dot));
    text += line(*key, name.substr(dot + 1)) + "\n";
  }
  return text;
}

}  // namespace clatter::validation
