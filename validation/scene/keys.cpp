// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/keys.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "validation/output/json.hpp"
#include "validation/scene/floors.hpp"
#include "validation/scene/orientation.hpp"

namespace clatter::validation {
namespace {

constexpr auto viscoelastic = analytic::RestitutionLaw::viscoelastic;

constexpr int most = 100'000;  // elements along an edge of a mesh
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

// Keys whose place another takes.
constexpr std::array mass_of_body{"body.mass"};
constexpr std::array speed_of_fall{"drop.speed"};
constexpr std::array speed_and_height{"drop.speed", "drop.height"};
constexpr std::array turns{"drop.angle_deg", "drop.tilt_deg"};
constexpr std::array ways_to_turn{"drop.angle_deg", "drop.tilt_deg", "drop.attitude"};
constexpr std::array before_release{"drop.speed",    "drop.height", "drop.clearance",        "drop.tangential_velocity",
                                    "drop.velocity", "drop.spin",   "drop.angular_velocity", "drop.topple"};
constexpr std::array height_and_before_release{
    "drop.speed", "drop.height",           "drop.clearance", "drop.tangential_velocity", "drop.velocity",
    "drop.spin",  "drop.angular_velocity", "drop.topple",    "drop.release.height"};
constexpr std::array attitude_before_release{"drop.angle_deg", "drop.tilt_deg", "drop.attitude", "drop.orientation"};
constexpr std::array angle_and_attitude_before_release{"drop.angle_deg", "drop.tilt_deg", "drop.attitude",
                                                       "drop.orientation", "drop.release.angle_deg"};
constexpr std::array all_of_motion{"drop.speed",    "drop.height", "drop.clearance",       "drop.tangential_velocity",
                                   "drop.velocity", "drop.spin",   "drop.angular_velocity"};
constexpr std::array springs{"ground.stiffness", "ground.damping"};
constexpr std::array losses{"ground.damping", "ground.dissipation"};
constexpr std::array springs_and_area{"ground.stiffness", "ground.damping", "ground.area"};
constexpr std::array springs_and_half_space{"ground.stiffness", "ground.damping", "ground.modulus"};
constexpr std::array all_but_floor_and_pad{"ground.stiffness", "ground.damping", "ground.area", "ground.modulus",
                                           "ground.under"};
constexpr std::array all_but_half_space{"ground.stiffness", "ground.damping",      "ground.area",
                                        "ground.curve",     "ground.curve_units",  "ground.thickness",
                                        "ground.under",     "ground.body_material"};
constexpr std::array half_space_alone{"ground.modulus"};
constexpr std::array spin_of_release{"drop.release.spin"};
constexpr std::array turn_of_plane{"drop.spin"};
constexpr std::array parts_of_velocity{"drop.speed", "drop.height", "drop.clearance", "drop.tangential_velocity"};

Echo null_if(bool none) { return none ? Echo::null : Echo::value; }
Echo only_if(bool shown) { return shown ? Echo::value : Echo::absent; }
/// Nothing there is null for the continuous model, to which all keys are shown.
Echo in_discrete_only_if(bool given, Model model) {
  return given || model == Model::continuous ? Echo::value : Echo::absent;
}
Echo of_release(const Scene& scene, Model) { return only_if(scene.is_released()); }
Echo of_rod(const Scene& scene, Model) { return only_if(scene.body.shape == BodyScene::Shape::rod); }
Echo of_length(const Scene& scene, Model) { return only_if(scene.body.has_length()); }
Echo of_radius(const Scene& scene, Model) { return only_if(scene.body.has_radius()); }
Echo of_size(const Scene& scene, Model) { return only_if(scene.body.has_size()); }
Echo of_sectors(const Scene& scene, Model) {
  return only_if(scene.body.shape == BodyScene::Shape::rod || (scene.body.is_round() && !scene.body.is_smooth()));
}
Echo of_box(const Scene& scene, Model) { return only_if(scene.body.shape == BodyScene::Shape::box); }
Echo of_mesh(const Scene& scene, Model) { return only_if(scene.body.shape == BodyScene::Shape::mesh); }

/// An impulse ratio of 0 says that there is no friction.
bool has_impulse_ratio(const Scene& scene) {
  return scene.impact.impulse_ratio || !(scene.impact.friction || takes_friction_of_ground(scene));
}
/// The discrete model has no use for keys of a ground that is not there.
Echo of_ground(const Scene& scene, Model model) { return only_if(model == Model::continuous || scene.has_ground()); }
Echo of_thickness(const Scene& scene, Model) { return only_if(scene.world.ground.is_pad() || scene.pad.thickness); }
Echo of_pad(const Scene& scene, Model) { return only_if(scene.world.ground.is_pad()); }
Echo of_dissipation(const Scene& scene, Model) {
  return only_if(scene.world.ground.has_dissipation() && !scene.ground_restitution);
}
Echo of_springs(const Scene& scene, Model model) {
  return scene.world.ground.has_dissipation() || scene.ground_restitution ? Echo::absent : of_ground(scene, model);
}
Echo of_area(const Scene& scene, Model model) {
  return scene.world.ground.is_half_space() || scene.half_space.floor ? Echo::absent : of_ground(scene, model);
}

std::size_t index_of(auto value) { return static_cast<std::size_t>(value); }

/// @param at  std::vector<double>& of a Scene&
template <auto at>
ListValue three_velocities(const char* example) {
  const auto get = [](const Scene& s) { return at(s); };
  const auto put = [](Scene& s, const std::vector<double>& v) { at(s) = v; };
  return {get, put, {3}, velocities, "three numbers from -1e9 to 1e9", example, &finite};
}

template <auto at>
ListValue euler_parameters() {
  const auto get = [](const Scene& s) { return at(s); };
  const auto put = [](Scene& s, const std::vector<double>& v) { at(s) = v; };
  return {
      get,           put, {4}, parameters, "four numbers q0, q1, q2, q3 of length 1 (normalised if within 0.01 of it)",
      "[1, 0, 0, 0]"};
}

void append_attitude(std::vector<Key>& keys) {
  keys.insert(keys.end(),
              {
                  {"drop.angle_deg", Use::both, "--angle", "DEG", "°",
                   "inclination at the first impact, end a low; 0 flat, 90 upright",
                   NumberValue{[](Scene& s) -> double& {
    return s.angle_deg; }, angles}, nullptr, true},
                  {"drop.tilt_deg", Use::both, "--tilt", "DEG", "°", "rotation about the body's long axis before that",
                   NumberValue{[](Scene& s) -> double& {
    return s.tilt_deg; }, tilts}},
                  {"drop.attitude", Use::both, "--attitude", "Q0,Q1,Q2,Q3", "",
                   "or Euler parameters, body to world, scalar first; the lowest vertex is put on the ground",
                   euler_parameters<[](auto& s) -> auto& { return s.attitude;
}
> (), nullptr, false, turns
}  // namespace
,
    {"drop.orientation",
     Use::both,
     "--orientation",
     "N",
     "",
     "or which part of a box points down: 1-6 faces, 7-18 edges, 19-26 corners",
     OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.orientation; }, orientations},
     nullptr,
     false,
     ways_to_turn},
}  // namespace clatter::validation
);
}

void append_motion(std::vector<Key>& keys) {
  keys.insert(
      keys.end(),
      {
          {"drop.start", Use::continuous, "--start", "", "",
           "begins with the first touch, or at rest on the ground, as deep as its weight presses it",
           NameValue{&start_names(), [](const Scene& s) -> std::size_t {
    return s.request.starts_on_ground; },
                     [](Scene& s, std::size_t i) {
    s.request.starts_on_ground = i == 1; }},
           [](const Scene& s, Model) {
    return only_if(s.request.starts_on_ground); }},
          {"drop.speed", Use::both, "--speed", "M/S", "m/s", "downward, of the centre of mass at first touch",
           NumberValue{[](Scene& s) -> double& {
    return s.speed; }, speeds, &positive_number},
           [](const Scene& s, Model model) {
    return null_if(!s.velocity.empty() || s.request.starts_on_ground || (s.falls() && model == Model::continuous));
           }},
          {"drop.height", Use::both, "--height", "M", "m", "or its height at release from rest",
           OptionalNumber{[](Scene& s) -> std::optional<double>& {
    return s.height; }, heights, &positive_number},
           nullptr, false, speed_of_fall},
          {"drop.clearance", Use::both, "--clearance", "M", "m",
           "or that of its lowest point at release from rest, the drop height of test standards",
           OptionalNumber{[](Scene& s) -> std::optional<double>& {
    return s.clearance; }, heights, &positive_number},
           nullptr, false, speed_and_height},
          {"drop.tangential_velocity", Use::both, "--tangential-velocity", "M/S", "m/s",
           "of the centre of mass, to the right",
           NumberValue{[](Scene& s) -> double& {
    return s.tangential_velocity; }, velocities, &finite}},
          {"drop.velocity", Use::both, "--velocity", "X,Y,Z", "m/s",
           "or all of it: of the centre of mass at the first touch, world",
           three_velocities<[](auto& s) -> auto& { return s.velocity;
}
> ("[0, 0, -1]"), nullptr, false, parts_of_velocity
}
,
    {"drop.spin",
     Use::both,
     "--spin",
     "RAD/S",
     "rad/s",
     "clockwise, as Omega in Eq. 8",
     NumberValue{[](Scene& s) -> double& { return s.spin; }, velocities, &finite}},
    {"drop.angular_velocity", Use::both, "--angular-velocity", "X,Y,Z", "rad/s",
     "or all of it: at the first touch, world components",
     three_velocities < [](auto& s) -> auto& {return s.angular_velocity;
}
> ("[0, 0, 0]"), nullptr, false, turn_of_plane
}
,
    {"drop.topple",
     Use::both,
     "--topple",
     "M",
     "m",
     "or let go from rest, end a raised by this: it turns about the lower edge of end b and lands flat",
     OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.topple; }, heights, &positive_number},
     nullptr,
     false,
     all_of_motion},
    {"drop.release.height",
     Use::both,
     "--release-height",
     "M",
     "m",
     "or let it fly freely, turning, to its first touch, from this height of the centre of mass",
     OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.release.height; }, heights, &positive_number},
     of_release,
     false,
     before_release},
    {"drop.release.clearance",
     Use::both,
     "--release-clearance",
     "M",
     "m",
     "or from this one of its lowest point",
     OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.release.clearance; }, heights, &positive_number},
     of_release,
     false,
     height_and_before_release},
    {"drop.release.angle_deg",
     Use::both,
     "--release-angle",
     "DEG",
     "°",
     "inclination at the release, end a low where positive; without it the angle, attitude or orientation above",
     OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.release.angle_deg; }, turns_of_release},
     of_release,
     false,
     attitude_before_release},
    {"drop.release.attitude", Use::both, "--release-attitude", "Q0,Q1,Q2,Q3", "", "or Euler parameters",
     euler_parameters < [](auto& s) -> auto& {return s.release.attitude;
}
> (), of_release, false, angle_and_attitude_before_release
}
, {"drop.release.velocity", Use::both, "--release-velocity", "X,Y,Z", "m/s",
   "of the centre of mass at the release, world; without it at rest",
   three_velocities < [](auto& s) -> auto& {return s.release.velocity;
}
> ("[0, 0, 0]"), of_release
}
,
    {"drop.release.spin",
     Use::both,
     "--release-spin",
     "RAD/S",
     "rad/s",
     "at the release, clockwise, as Omega in Eq. 8; without it none",
     OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.release.spin; }, velocities},
     of_release},
    {"drop.release.angular_velocity", Use::both, "--release-angular-velocity", "X,Y,Z", "rad/s",
     "or all of it, world components", three_velocities < [](auto& s) -> auto& {return s.release.angular_velocity;
}
> ("[0, 0, 0]"), of_release, false, spin_of_release
}
,
    {"world.gravity",
     Use::both,
     "--gravity",
     "M/S2",
     "m/s²",
     "acceleration of free fall; 9.81 where a height, clearance, topple, release or incline is given, else 0",
     NumberValue{[](Scene& s) -> double& { return s.world.gravity; }, gravities, &not_negative_number}},
    {"world.incline_deg",
     Use::both,
     "--incline",
     "DEG",
     "°",
     "slope of the ground, down to the right where positive; x and z are along and across the ground",
     NumberValue{[](Scene& s) -> double& { return s.world.incline_deg; }, slopes},
     [](const Scene& s, Model) { return only_if(s.world.incline_deg != 0); }},
});
}

void append_impact(std::vector<Key>& keys) {
  keys.insert(
      keys.end(),
      {
          {"impact.restitution", Use::both, "--restitution", "E", "",
           "coefficient of the discrete model; without it from the ground's damping, or 1 without a ground",
           OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.impact.restitution; }, restitutions},
           [](const Scene& s, Model) { return null_if(restitution_law(s) == viscoelastic); }},
          {"impact.law", Use::both, "--restitution-law", "", "",
           "what the coefficient relates; viscoelastic: it follows from the ground's damping and the approach speed, "
           "as "
           "it does where a ground and no restitution is given",
           NameValue{&law_names(), [](const Scene& s) { return index_of(restitution_law(s)); },
                     [](Scene& s, std::size_t i) { s.impact.law = static_cast<analytic::RestitutionLaw>(i); }}},
          {"impact.impulse_ratio", Use::both, "--impulse-ratio", "MU_I", "",
           "Eq. 8's ratio of tangential to normal impulse",
           OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.impact.impulse_ratio; }, finite},
           [](const Scene& s, Model model) { return in_discrete_only_if(has_impulse_ratio(s), model); }},
          {"impact.friction", Use::both, "--friction", "MU", "",
           "or Coulomb's coefficient of friction; without either the ground's sliding_friction",
           OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.impact.friction; }, not_negative_number},
           [](const Scene& s, Model model) { return in_discrete_only_if(s.impact.friction.has_value(), model); }},
          {"impact.friction_law", Use::both, "--impact-friction-law", "", "",
           "coulomb: against the slip at every instant of the impact; moreau: against that after it, as time-steppers "
           "have it, with newton's restitution",
           NameValue{&impact_friction_names(), [](const Scene& s) { return std::size_t{s.impact.is_moreau}; },
                     [](Scene& s, std::size_t i) { s.impact.is_moreau = i == 1; }},
           [](const Scene& s, Model) { return only_if(s.impact.is_moreau); }},
      });
}

void append_shape(std::vector<Key>& keys) {
  keys.insert(
      keys.end(),
      {
          {"body.shape", Use::both, "--body", "", "", "shape of what falls; a rod with a radius is a cylinder",
           NameValue{&shape_names(), [](const Scene& s) { return index_of(s.body.shape); },
                     [](Scene& s, std::size_t i) { s.body.shape = static_cast<BodyScene::Shape>(i); }}},
          {"body.mass", Use::both, "--mass", "KG", "kg", "mass",
           NumberValue{[](Scene& s) -> double& { return s.body.mass; }, masses, &wide_masses}},
          {"body.length", Use::both, "--length", "M", "m", "of the rod; of the capsule over all",
           NumberValue{[](Scene& s) -> double& { return s.body.length; }, sizes, &wide_sizes}, of_length},
          {"body.radius", Use::both, "--radius", "M", "m", "of the rod, sphere or capsule",
           NumberValue{[](Scene& s) -> double& { return s.body.radius; }, radii, &wide_radii}, of_radius},
          {"body.size", Use::both, "--size", "LxWxT", "m",
           "of the box or ellipsoid, whole axes in m, as 0.15x0.075x0.008: along the inclination, across, upright at 0 "
           "degrees",
           ListValue{[](const Scene& s) {
                       return std::vector<double>{s.body.size.x(), s.body.size.y(), s.body.size.z()};
                     },
                     [](Scene& s, const std::vector<double>& v) {
                       s.body.size = {v[0], v[1], v[2]};
                     },
                     {3},
                     sizes,
                     "three lengths in m greater than 0, as in [0.106, 0.044, 0.019]",
                     "[0.106, 0.044, 0.019]",
                     &wide_sizes},
           of_size},
      });
}

void append_mesh(std::vector<Key>& keys) {
  keys.insert(
      keys.end(),
      {
          {"body.mesh.sectors", Use::continuous, "", "N", "",
           "elements around the x axis of what is round; a rod has 16 without it, or 64 where its radius is above a "
           "twentieth of its length; a sphere, ellipsoid or capsule is a mesh, and no more smooth, where it is given",
           WholeNumber{[](Scene& s) -> int& { return s.body.sectors; }, 3, most}, of_sectors},
          {"body.mesh.rings", Use::continuous, "", "N", "",
           "from a rod's axis outward, 4 without it; else from each pole to the equator, as with the sectors",
           WholeNumber{[](Scene& s) -> int& { return s.body.rings; }, 1, most}, of_sectors},
          {"body.mesh.layers", Use::continuous, "", "N", "", "along it",
           WholeNumber{[](Scene& s) -> int& { return s.body.layers; }, 1, most}, of_rod},
          {"body.mesh.nx", Use::continuous, "", "N", "", "elements along the box",
           WholeNumber{[](Scene& s) -> int& { return s.body.nx; }, 1, most}, of_box},
          {"body.mesh.ny", Use::continuous, "", "N", "", "across it",
           WholeNumber{[](Scene& s) -> int& { return s.body.ny; }, 1, most}, of_box},
          {"body.mesh.nz", Use::continuous, "", "N", "", "through its thickness",
           WholeNumber{[](Scene& s) -> int& { return s.body.nz; }, 1, most}, of_box},
          {"body.mesh.file", Use::both, "--mesh", "FILE", "",
           "a mesh as the body: STL, OBJ, PLY, OFF, glTF, 3MF or COLLADA, closed but for small faults; Gmsh's .msh and "
           ".geo, STEP",
           TextValue{[](Scene& s) -> std::string& { return s.body.file; }}, of_mesh},
          {"body.mesh.unit", Use::both, "--unit", "M", "m",
           "of the mesh file's coordinates; without it what the file names, else m",
           NumberValue{[](Scene& s) -> double& { return s.body.unit; }, file_units}, of_mesh},
          {"body.mesh.weld", Use::both, "", "X", "",
           "corners at gaps that are closer than this are one, of the largest extent; 0: only equal ones",
           NumberValue{[](Scene& s) -> double& { return s.body.weld; }, welds}, of_mesh},
          {"body.mesh.strict", Use::both, "", "true|false", "", "a mesh that needs repair is refused",
           TruthValue{[](Scene& s) -> bool& { return s.body.strict; }}, of_mesh},
          {"body.mesh.density", Use::both, "", "KG/M3", "kg/m³", "of a file's body, or body.mass",
           OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.body.density; }, positive_number},
           [](const Scene& s, Model) { return only_if(s.body.density.has_value()); }, false, mass_of_body},
      });
}

void append_mass_properties(std::vector<Key>& keys) {
  keys.insert(keys.end(),
              {
                  {"body.inertia", Use::both, "--inertia", "LIST", "kg m²",
                   "about the centre of mass, principal or xx, yy, zz, xy, xz, yz in body axes; without it the uniform "
                   "body's about its own centre",
                   ListValue{[](const Scene& s) { return s.body.inertia; },
                             [](Scene& s, const std::vector<double>& v) { s.body.inertia = v; },
                             {3, 6},
                             finite,
                             "three principal moments in kg m2, or six numbers xx, yy, zz, xy, xz, yz",
                             "[1, 1, 1]"}},
                  {"body.centre", Use::both, "--centre", "X,Y,Z", "m",
                   "of mass, from the geometric centre, of a mesh in its file's frame and unit; without "
                   "it that of the enclosed volume",
                   ListValue{[](const Scene& s) { return s.body.centre; },
                             [](Scene& s, const std::vector<double>& v) { s.body.centre = v; },
                             {3},
                             finite,
                             "three coordinates in m, of a mesh in its file's unit",
                             "[0, 0, 0]"}},
                  {"body.merge", Use::continuous, "", "true|false", "", "coplanar elements become one facet",
                   TruthValue{[](Scene& s) -> bool& { return s.body.merge; }}},
              });
}

void append_ground(std::vector<Key>& keys) {
  keys.insert(
      keys.end(),
      {
          {"ground.stiffness", Use::both, "--stiffness", "N/M3", "N/m³",
           "k_G, pressure of the ground for each metre of depth; clatter shock --ground finds it; or ground.modulus, "
           "ground.floor or ground.curve",
           NumberValue{[](Scene& s) -> double& { return s.world.ground.stiffness; }, positive_number},
           [](const Scene& s, Model model) {
             if (s.world.ground.has_dissipation()) return Echo::absent;
             return s.has_ground() ? Echo::value : model == Model::continuous ? Echo::null : Echo::absent;
           },
           true},
          {"ground.damping", Use::both, "--damping", "N.S/M4", "N·s/m⁴",
           "c_G, the same for each m/s at which the depth grows",
           NumberValue{[](Scene& s) -> double& { return s.world.ground.damping; }, not_negative_number}, of_springs},
          {"ground.modulus", Use::both, "--ground-modulus", "PA", "Pa",
           "E* of an elastic half-space, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 of ground and body: it is harder under "
           "small patches than under large ones",
           NumberValue{[](Scene& s) -> double& { return s.half_space.modulus; }, positive_number},
           [](const Scene& s, Model) { return only_if(s.half_space.modulus > 0); }, false, springs_and_area},
          {"ground.floor", Use::both, "--floor", "", "",
           "or a named floor, a half-space of published numbers (clatter shock --ground shows them) under a body of "
           "ground.body_material; with ground.curve what is under the pad where it bottoms out",
           NameValue{&floor_names(), [](const Scene& s) { return s.half_space.floor.value_or(0); },
                     [](Scene& s, std::size_t i) { s.half_space.floor = i; }},
           [](const Scene& s, Model) { return only_if(s.half_space.floor.has_value()); }, false, all_but_floor_and_pad},
          {"ground.body_modulus", Use::both, "--body-modulus", "PA", "Pa",
           "E/(1 - nu^2) of the body on a half-space, whose modulus is then the ground's alone",
           OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.half_space.body_modulus; },
                          positive_number},
           [](const Scene& s, Model) { return only_if(s.half_space.body_modulus.has_value()); }, false,
           all_but_half_space},
          {"ground.body_material", Use::both, "--body-material", "NAME", "",
           "or what the body is made of: abs, steel, glass and others of clatter help keys; on a named floor abs "
           "without it",
           NameValue{&body_material_names(), [](const Scene& s) { return s.half_space.body_material.value_or(0); },
                     [](Scene& s, std::size_t i) { s.half_space.body_material = i; }},
           [](const Scene& s, Model) {
             return only_if(s.half_space.body_material || (s.half_space.floor && !s.half_space.body_modulus));
           },
           false, springs_and_area},
          {"ground.dissipation", Use::both, "--dissipation", "S/M", "s/m",
           "of a half-space or a pad: Hunt and Crossley's factor on its pressure, 1 + dissipation times the speed at "
           "which the depth grows",
           NumberValue{[](Scene& s) -> double& { return s.world.ground.dissipation; }, not_negative_number},
           of_dissipation, false, springs},
          {"ground.restitution", Use::both, "--floor-restitution", "E", "",
           "or the restitution of the first impact, from whose approach speed damping or dissipation follow (exact of "
           "a "
           "flat or upright landing without friction)",
           OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.ground_restitution; }, losses_allowed},
           [](const Scene& s, Model) { return only_if(s.ground_restitution.has_value()); }, false, losses},
          {"ground.curve", Use::both, "--curve", "CURVE", "",
           "or a pad by what its data sheet has: strain (with ground.thickness) or depth, and pressure, straight "
           "between the points and from 0, 0 to the first",
           CurveValue{
               [](Scene& s) -> PadScene::Points& { return s.pad.curve; },
               [](Scene& s) -> std::string& { return s.pad.file; },
               "a CSV file whose header states units, or two or more points [[x, pressure], ...], x strain or m, "
               "pressure in Pa, neither of which falls",
               "[[0, 0], [0.1, 2e4], [0.6, 5e4]]"},
           of_pad, false, springs_and_half_space},
          {"ground.curve_units", Use::both, "--curve-units", "X,P", "",
           "of the curve's two columns, as %,kPa; without it those of a file's header, or m, or 1 with a thickness, "
           "and "
           "Pa",
           TextValue{[](Scene& s) -> std::string& { return s.pad.units; }}, of_pad, false, springs_and_half_space},
          {"ground.thickness", Use::both, "--thickness", "M", "m",
           "of the pad, by which strain becomes depth; under springs it warns of impacts too deep for them; in clatter "
           "shock --ground of a layer",
           OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.pad.thickness; }, positive_number},
           of_thickness, false, half_space_alone},
          {"ground.under", Use::both, "--under", "PA/M", "Pa/m",
           "stiffness of the pad beyond its curve's last point, where it bottoms out; without it or ground.floor that "
           "before the point",
           OptionalNumber{[](Scene& s) -> std::optional<double>& { return s.pad.under; }, positive_number}, of_pad,
           false, springs_and_half_space},
          {"ground.static_friction", Use::both, "--static-friction", "MU", "",
           "of the ground; without it sliding_friction",
           NumberValue{[](Scene& s) -> double& { return s.world.ground.static_friction; }, not_negative_number},
           of_ground},
          {"ground.sliding_friction", Use::both, "--sliding-friction", "MU", "",
           "of the ground; without it static_friction",
           NumberValue{[](Scene& s) -> double& { return s.world.ground.sliding_friction; }, not_negative_number},
           of_ground},
          {"ground.area", Use::both, "--area", "", "",
           "area over which the load is integrated; of a pad projected without it",
           NameValue{&area_names(), [](const Scene& s) { return index_of(s.world.ground.area); },
                     [](Scene& s, std::size_t i) { s.world.ground.area = static_cast<numeric::AreaMeasure>(i); }},
           of_area},
          {"ground.friction_law", Use::both, "", "NAME", "", "what friction does where the face slips unevenly",
           NameValue{&friction_law_names(), [](const Scene& s) { return index_of(s.world.ground.friction); },
                     [](Scene& s, std::size_t i) { s.world.ground.friction = static_cast<numeric::FrictionLaw>(i); }},
           of_ground},
          {"ground.regularisation_speed", Use::both, "", "M/S", "m/s", "v_r of the regularised law",
           NumberValue{[](Scene& s) -> double& { return s.world.ground.regularisation_speed; }, positive_number},
           of_ground},
      });
}

void append_run(std::vector<Key>& keys) {
  keys.insert(
      keys.end(),
      {
          {"run.impacts", Use::both, "--impacts", "N", "", "most impacts to report",
           WholeNumber{[](Scene& s) -> int& { return s.request.impacts; }, 1, 1'000'000}},
          {"run.until_rest", Use::discrete, "--until-rest", "", "",
           "discrete model: go on until the body rests, or no impact follows, for 100000 impacts at most; exit status "
           "3 "
           "if that is not enough",
           TruthValue{[](Scene& s) -> bool& { return s.until_rest; }},
           [](const Scene& s, Model) { return s.until_rest ? Echo::value : Echo::absent; }},
          {"run.until", Use::both, "--until", "S", "s",
           "the run ends at this time since the first impact; 100000 impacts at most",
           NumberValue{[](Scene& s) -> double& { return s.request.until; }, positive_number},
           [](const Scene& s, Model) { return only_if(std::isfinite(s.request.until)); }},
          {"run.at", Use::both, "--at", "T,...", "s",
           "times since the first impact at which the state is printed, too, with its errors",
           ListValue{[](const Scene& s) { return s.times; },
                     [](Scene& s, const std::vector<double>& v) { s.times = v; },
                     {},
                     finite,
                     "times in s",
                     "[0.1, 0.5]"},
           [](const Scene& s, Model) { return only_if(!s.times.empty()); }},
          {"run.rate", Use::both, "--rate", "HZ", "Hz",
           "the same at equal steps from the first impact to run.until, or to the last impact",
           NumberValue{[](Scene& s) -> double& { return s.rate; }, positive_number},
           [](const Scene& s, Model) { return only_if(s.rate > 0); }},
          {"run.digits", Use::both, "--digits", "N", "", "significant digits asked for",
           WholeNumber{[](Scene& s) -> int& { return s.accuracy.digits; }, 2, 12, 1, 15}},
          {"run.require_digits", Use::both, "--require-digits", "", "", "exit status 3 if fewer digits are known",
           TruthValue{[](Scene& s) -> bool& { return s.require_digits; }}},
          {"run.method", Use::continuous, "--method", "NAME", "", "auto, tvd-rk3, rk4, rkf45, rkck or rk8pd",
           NameValue{&method_names(), [](const Scene& s) { return index_of(s.accuracy.method); },
                     [](Scene& s, std::size_t i) { s.accuracy.method = static_cast<numeric::Method>(i); }}},
          {"run.tolerance", Use::continuous, "--tolerance", "TOL", "", "local error per step of an adaptive method",
           NumberValue{[](Scene& s) -> double& { return s.accuracy.tolerance; }, tolerances},
           [](const Scene& s, Model) { return null_if(!(s.accuracy.tolerance > 0)); }},
          {"run.step", Use::continuous, "--step", "S", "s", "of tvd-rk3",
           NumberValue{[](Scene& s) -> double& { return s.accuracy.step; }, positive_number},
           [](const Scene& s, Model) { return null_if(!(s.accuracy.step > 0)); }},
          {"run.history", Use::continuous, "--history", "FILE", "", "time history as CSV",
           TextValue{[](Scene& s) -> std::string& { return s.history; }},
           [](const Scene& s, Model) { return null_if(s.history.empty()); }},
          {"run.planar", Use::continuous, "--planar", "", "", "keep the motion in its plane",
           TruthValue{[](Scene& s) -> bool& { return s.world.planar; }}},
          {"run.contact_gravity", Use::continuous, "--no-contact-gravity", "", "",
           "whether gravity acts during contacts too; with the flag it acts in flight only",
           TruthValue{[](Scene& s) -> bool& { return s.world.gravity_in_contact; }}},
      });
}

void append_estimates(std::vector<Key>& keys) {
  keys.insert(
      keys.end(),
      {
          {"run.evaluation_limit", Use::continuous, "", "N", "",
           "of the contact forces; then the run ends with the rows so far",
           LongNumber{[](Scene& s) -> long& { return s.accuracy.evaluation_limit; }, 1, 1'000'000'000'000}},
          {"run.errors", Use::continuous, "", "true|false", "",
           "errors by a finer run, which costs more than the run itself; false leaves them out",
           TruthValue{[](Scene& s) -> bool& { return s.request.error_estimates; }}},
          {"run.amplification", Use::continuous, "", "true|false", "",
           "their growth by a neighbouring run, a quarter of the run itself; false leaves it out",
           TruthValue{[](Scene& s) -> bool& { return s.request.amplification; }}},
          {"run.note_local_slip", Use::continuous, "--note-local-slip", "", "",
           "estimate what each place's own slip would change, however little; else only with run.errors, where it may "
           "matter",
           TruthValue{[](Scene& s) -> bool& { return s.request.local_slip; }}},
      });
}

}  // namespace

const std::vector<Key>& all_keys() {
  static const std::vector<Key> keys = [] {
    std::vector<Key> rows;
    append_attitude(rows);
    append_motion(rows);
    append_impact(rows);
    append_shape(rows);
    append_mesh(rows);
    append_mass_properties(rows);
    append_ground(rows);
    append_run(rows);
    append_estimates(rows);
    return rows;
  }();
  return keys;
}

namespace {

/// What flags alone give a body of this shape.
Scene bare_scene(BodyScene::Shape shape) {
  Scene scene;
  scene.body.shape = shape;
  scene.world.ground.stiffness = 0;
  scene.world.gravity = 0;
  return scene;
}

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
