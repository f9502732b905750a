// SPDX-License-Identifier: GPL-3.0-or-later
// How a scene file and the flags that override it become a checked scene: each key by its row, then what keys have to
// do with each other.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>

#include "numeric/files/import.hpp"
#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/floors.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/orientation.hpp"
#include "validation/scene/pad.hpp"
#include "validation/scene/scene.hpp"
#include "validation/scene/scene_values.hpp"

namespace clatter::validation {
namespace {

constexpr int most_values = 1'000'000;
constexpr std::array<const char*, 5> range_parts{".from", ".to", ".step", ".count", ".scale"};
const char* const forms = "a sweep is a list, or has from, to and step or count";
const std::vector<std::string> scales{"linear", "log"};

SceneSweep read_list(const SceneValues& values, const std::string& key, const Range& range) {
  SceneSweep sweep;
  sweep.listed = values.number_list(key, range);
  const auto [least, largest] = std::minmax_element(sweep.listed.begin(), sweep.listed.end());
  sweep.from = *least;
  sweep.to = *largest;
  return sweep;
}

void read_count(const SceneValues& values, const std::string& table, SceneSweep& sweep) {
  values.exclude(table + ".count", table + ".step");
  sweep.count = values.integer(table + ".count", 0, 2, most_values);
  sweep.logarithmic = values.name(table + ".scale", 0, scales) == 1;
  if (sweep.logarithmic && !(sweep.from > 0)) values.refuse(table + ".from", "greater than 0 with scale = \"log\"");
}

SceneSweep read_grid(const SceneValues& values, const std::string& table, const Range& range) {
  for (const char* key : {".from", ".to"}) values.require(table + key, forms);
  SceneSweep sweep;
  sweep.from = values.number(table + ".from", 0, range);
  sweep.to = values.number(table + ".to", 0, range);
  if (!(sweep.to >= sweep.from)) values.refuse(table + ".to", "at least the sweep's from");
  if (values.has(table + ".count")) {
    read_count(values, table, sweep);
    return sweep;
  }
  values.require(table + ".step", forms);
  if (values.has(table + ".scale")) values.refuse(table + ".scale", "left out with step; give count");
  sweep.step = values.number(table + ".step", 1, positive_number);
  if (!((sweep.to - sweep.from) / sweep.step <= most_values))
    values.refuse(table + ".step", fmt::format("at most {} values", most_values));
  return sweep;
}

/// Value i of `count` from one end to the other.
double placed(const SceneSweep& sweep, long long i) {
  if (i == sweep.count - 1) return sweep.to;
  if (sweep.logarithmic) return clean_ratio(sweep.from, sweep.to, i, sweep.count);
  return clean_step(sweep.from, (sweep.to - sweep.from) / static_cast<double>(sweep.count - 1), i);
}

}  // namespace

std::vector<double> SceneSweep::values() const {
  if (!listed.empty()) return listed;
  std::vector<double> values;
  for (long long i = 0; i < count; ++i) values.push_back(placed(*this, i));
  if (count > 0) return values;
  const long long steps = count_of_steps((to - from) / step);
  for (long long i = 0; i < steps; ++i) values.push_back(std::min(clean_step(from, step, i), to));
  return values;
}

const std::string& SceneSweep::name() const { return sweep_names()[static_cast<std::size_t>(quantity)]; }

Value SceneSweep::fields() const {
  if (!listed.empty()) return listed;
  Value fields = Value::Fields{{"from", from}, {"to", to}};
  if (count > 0) fields["count"] = count;
  else fields["step"] = step;
  if (logarithmic) fields["scale"] = "log";
  return fields;
}

namespace {

/// The sweep of a file, if it has one: under "sweep" a quantity's name with
///     [A, B, ...]                                    these values, in their order
///     { from = A, to = B, step = S }                 A, A + S, ... as far as B
///     { from = A, to = B, count = N }                N values at equal distances, both ends taken
///     { from = A, to = B, count = N, scale = "log" } N values with equal ratios, A > 0
/// @throws BadInput naming the key, what was given and what is allowed.
std::optional<SceneSweep> read_sweep_table(const SceneValues& values) {
  std::optional<SceneSweep> sweep;
  for (std::size_t i = 0; i < sweep_names().size(); ++i) {
    const std::string table = "sweep." + sweep_names()[i];
    if (!values.has(table) && !values.has_table(table)) continue;
    if (sweep) throw BadInput("{}: {}: only one quantity can be swept", values.path(), table);
    const Key& key = key_named(i == 0 ? "drop.angle_deg" : "ground.sliding_friction");
    const Range& range = key.value.range;
    sweep = values.has(table) ? read_list(values, table, range) : read_grid(values, table, range);
    sweep->quantity = static_cast<SceneSweep::Quantity>(i);
  }
  return sweep;
}

/// Leaves out all that the file says of the sweep of `name`.
void drop_sweep(SceneValues& values, const std::string& name) {
  values.drop("sweep." + name);
  for (const char* part : range_parts) values.drop("sweep." + name + part);
}

void only_for(const SceneValues& values, const std::vector<std::string>& keys, const std::string& what) {
  for (const std::string& key : keys) {
    if (values.has(key)) values.refuse(key, "left out: it is only for " + what);
  }
}

/// What was given for a key, or none.
const SceneOverride* given(const std::vector<SceneOverride>& overrides, std::string_view key) {
  const auto found = std::ranges::find(overrides, key, &SceneOverride::key);
  return found == overrides.end() ? nullptr : &*found;
}

void refuse_both(const std::vector<SceneOverride>& overrides, const char* first, const char* second) {
  const SceneOverride *const one = given(overrides, first), *const other = given(overrides, second);
  if (!one || !other) return;
  throw BadInput("{} and {}: give one of them, not both", one->flag, other->flag);
}

void check_mesh(const SceneValues& values, BodyScene& body) {
  values.require("body.mesh.file", "a file such as part.stl");
  body.mesh_file = unread_mesh();
  body.file = values.file("body.mesh.file");
  body.has_unit = values.has("body.mesh.unit");
  note_read(body.file);
  if (body.is_surface() && !body.density)
    values.require("body.mass", "or body.mesh.density: a surface of triangles has neither");
}

/// "a rod, sphere or capsule".
std::string shapes_with(bool ShapeTraits::*property) {
  std::vector<std::string> names;
  for (const ShapeTraits& shape : shape_traits) {
    if (shape.*property) names.emplace_back(shape.name);
  }
  const std::string last = names.size() > 1 ? " or " + names.back() : "";
  if (names.size() > 1) names.pop_back();
  return fmt::format("a {}{}", fmt::join(names, ", "), last);
}

void check_body(const SceneValues& values, BodyScene& body) {
  using Shape = BodyScene::Shape;
  if (body.shape != Shape::rod) only_for(values, {"body.mesh.layers"}, "a rod");
  if (!body.has_length()) only_for(values, {"body.length"}, shapes_with(&ShapeTraits::has_length));
  if (!body.has_radius()) only_for(values, {"body.radius"}, shapes_with(&ShapeTraits::has_radius));
  if (!body.traits().has_sectors)
    only_for(values, {"body.mesh.sectors", "body.mesh.rings"}, shapes_with(&ShapeTraits::has_sectors));
  if (!body.has_size()) only_for(values, {"body.size"}, shapes_with(&ShapeTraits::has_size));
  if (body.shape != Shape::box) only_for(values, {"body.mesh.nx", "body.mesh.ny", "body.mesh.nz"}, "a box");
  if (body.shape != Shape::mesh)
    only_for(values, {"body.mesh.file", "body.mesh.unit", "body.mesh.density", "body.mesh.weld", "body.mesh.strict"},
             "a mesh");
  if (body.shape == Shape::box) values.require("body.size", "the box's [L, W, T] in m");
  if (body.shape == Shape::mesh) check_mesh(values, body);
  if (body.shape == Shape::ellipsoid) {
    values.require("body.size", "the ellipsoid's axes [L, W, T] in m");
    if (!(body.size.minCoeff() >= 1e-6 * body.size.maxCoeff()))
      values.refuse("body.size", "an ellipsoid's, with no axis below 1e-6 of the largest");
  }
  if (!body.is_round() || !body.has_radius()) return;
  values.require("body.radius", "in m");
  if (!(body.radius > 0)) values.refuse("body.radius", "greater than 0 here");
  if (!body.has_length()) return;
  values.require("body.length", "the capsule's, over all, in m");
  if (!(body.length >= 2 * body.radius)) values.refuse("body.length", "at least twice body.radius");
}

void check_ground(const SceneValues& values, Scene& scene, Model model) {
  numeric::Ground& ground = scene.world.ground;
  const bool is_pad = values.has("ground.curve"), has_floor = values.has("ground.floor"),
             is_half_space = !is_pad && (values.has("ground.modulus") || has_floor);
  const bool is_springs = !is_half_space && !is_pad;
  if (!is_half_space && !has_floor)
    only_for(values, {"ground.body_modulus", "ground.body_material"}, "a ground with a modulus or a floor");
  if (!is_pad) only_for(values, {"ground.curve_units", "ground.under"}, "a pad with a curve");
  if (!is_pad && (is_half_space || !values.has("ground.stiffness")))
    only_for(values, {"ground.thickness"}, "a pad with a curve or a stiffness");
  if (model == Model::continuous && is_springs)
    values.require(
        "ground.stiffness",
        "k_G in N/m3, such as 1e11, which clatter shock --ground finds; or ground.modulus of an elastic half-space, "
        "ground.floor by name, or ground.curve of a pad; a scene without a ground has the discrete model alone, whose "
        "cost clatter sweep --dry-run tells");
  if (is_half_space) settle_half_space(scene.half_space, ground);
  if (!values.has("ground.stiffness") && is_springs) {
    only_for(values, {"ground.damping", "ground.restitution", "ground.static_friction", "ground.sliding_friction"},
             "a ground with a stiffness");
  }
  if (is_springs) only_for(values, {"ground.dissipation"}, "a ground with a modulus or a curve");
  else if (is_half_space || !values.has("ground.area")) ground.area = numeric::AreaMeasure::projected;
  if (is_pad) {
    read_pad(values, scene.pad);
    if (has_floor && !(pad_left(scene.pad) > 0))
      values.refuse("ground.floor", "left out under a pad without ground.thickness beyond its curve");
    settle_pad(scene.pad, scene.half_space, ground);
  }
  // One coefficient given is both.
  if (!values.has("ground.sliding_friction")) ground.sliding_friction = ground.static_friction;
  if (!values.has("ground.static_friction")) ground.static_friction = ground.sliding_friction;
  if (!(ground.static_friction >= ground.sliding_friction)) {
    values.refuse("ground.static_friction",
                  fmt::format("at least ground.sliding_friction, {}", shortest(ground.sliding_friction)));
  }
}

void check_accuracy(const SceneValues& values, const numeric::Accuracy& accuracy) {
  using numeric::Method;
  const bool takes_step = accuracy.method == Method::automatic || accuracy.method == Method::tvd_rk3;
  if (values.has("run.step") && !takes_step)
    values.refuse("run.step", fmt::format("left out: {} chooses its own", method_name(accuracy.method)));
  if (values.has("run.tolerance") && (accuracy.step > 0 || accuracy.method == Method::tvd_rk3))
    values.refuse("run.tolerance", "left out: a fixed step has none");
}

void check_sweep(const SceneValues& values, Scene& scene) {
  const std::string other = "a scene that does not sweep it";
  if (!scene.sweep) return;
  if (scene.sweep->quantity == SceneSweep::Quantity::angle_deg) {
    only_for(values, {"drop.angle_deg", "drop.attitude", "drop.orientation"}, other);
    scene.angle_deg = scene.sweep->from;
  } else {
    only_for(values, {"ground.static_friction", "ground.sliding_friction"}, other);
  }
  if (!scene.history.empty()) values.refuse("run.history", "left out in a sweep");
}

/// Keys with which a body falls before it touches.
constexpr std::array falls_from{"drop.height", "drop.clearance", "drop.topple", "drop.release.height",
                                "drop.release.clearance"};

/// The angle of a turn about −y by these Euler parameters.
double inclination_of(const std::vector<double>& q) {
  constexpr double degree = std::numbers::pi / 180;
  return std::remainder(2 * std::atan2(-q[2], q[0]) / degree, 360);
}

/// What has no meaning for a body that lies on the ground.
constexpr std::array motions_before_touch{"drop.speed",  "drop.height",         "drop.clearance",
                                          "drop.topple", "drop.release.height", "drop.release.clearance"};

bool starts_at_rest(const SceneValues& values) {
  return values.has("drop.start") && values.text("drop.start") == "rest";
}

void check_start(const SceneValues& values, const Scene& scene, Model model) {
  if (model == Model::discrete && starts_at_rest(values))
    values.refuse("drop.start", "\"touch\" or left out: the discrete model begins with the first impact");
  if (!scene.request.starts_on_ground) return;
  for (const char* const motion : motions_before_touch) {
    if (values.has(motion)) values.refuse(motion, "left out with drop.start = \"rest\"");
  }
  if (values.has("ground.restitution"))
    values.refuse("ground.restitution", "left out with drop.start = \"rest\", where no first impact has it");
  if (!(scene.world.gravity > 0)) values.refuse("drop.start", "\"touch\" where world.gravity is 0");
  if (!scene.velocity.empty() && scene.velocity[2] != 0)
    values.refuse("drop.velocity", "along the ground with drop.start = \"rest\"");
}

/// Whether a motion that cannot be refuses the scene, or is left to whoever runs it.
enum class Motion { required, left_open };

void check_drop(const SceneValues& values, Scene& scene, Motion of_scene) {
  const bool swept = scene.sweep && scene.sweep->quantity == SceneSweep::Quantity::angle_deg;
  try {
    scene.settle();
  } catch (const BadInput&) {
    if (of_scene == Motion::required || !scene.topple) throw;
  }
  if (!scene.attitude.empty()) {
    const char* const key = scene.release.attitude.empty() ? "drop.attitude" : "drop.release.attitude";
    if (!is_attitude(scene.attitude)) values.refuse(key, key_named(key).allowed());
  } else if (!swept && !scene.topple && !scene.release.angle_deg && scene.body.shape != BodyScene::Shape::sphere) {
    if (scene.is_released() && !values.has("drop.angle_deg"))
      values.require("drop.release.angle_deg",
                     "the inclination at the release, or an attitude, --orientation of a box");
    values.require("drop.angle_deg", "the inclination at the first impact, or drop.attitude");
  }
  if (!scene.is_released()) {
    only_for(values,
             {"drop.release.angle_deg", "drop.release.attitude", "drop.release.velocity", "drop.release.spin",
              "drop.release.angular_velocity"},
             "a drop with drop.release.height or drop.release.clearance");
  }
  for (const char* key : falls_from) {
    if (!values.has(key)) continue;
    const bool may_float = std::string_view(key).starts_with("drop.release.");
    if (!may_float && !(scene.world.gravity > 0)) values.refuse(key, "left out where world.gravity is 0");
    if (scene.world.incline_deg != 0)
      values.refuse("world.incline_deg", fmt::format("0 or left out with {}: give the velocity at the touch", key));
  }
  if (scene.world.incline_deg != 0 && !(scene.world.gravity > 0))
    values.refuse("world.incline_deg", "0 or left out where world.gravity is 0");
}

/// The same for files, flags and Python: the paper's thin rod, without gravity unless something falls or the ground
/// slopes.
Scene default_scene(const SceneValues& values) {
  Scene scene;
  scene.path = values.path();
  scene.world.ground.stiffness = 0;  // none, until it is given
  const auto is_given = [&](const char* key) { return values.has(key); };
  scene.world.gravity =
      is_given("world.incline_deg") || starts_at_rest(values) || std::ranges::any_of(falls_from, is_given) ? 9.81 : 0;
  return scene;
}

/// Which of the laws' numbers go together, and which a ground must give.
void check_impact(const SceneValues& values, const Scene& scene) {
  using analytic::RestitutionLaw;
  if (scene.impact.is_moreau) {
    if (restitution_law(scene) != RestitutionLaw::newton)
      values.refuse("impact.friction_law", "moreau with newton's restitution alone: give impact.restitution");
    if (!scene.impact.friction && !takes_friction_of_ground(scene))
      values.refuse("impact.friction_law", "moreau with a coefficient, impact.friction");
  }
  if (!scene.impact.law || *scene.impact.law == RestitutionLaw::newton) return;
  const bool is_viscoelastic = *scene.impact.law == RestitutionLaw::viscoelastic;
  if (is_viscoelastic && !scene.has_ground())
    values.refuse("impact.law", "another law where no ground is given, whose damping it takes");
  if (is_viscoelastic && scene.impact.restitution)
    values.refuse("impact.restitution", "left out: the viscoelastic law takes it from the ground's damping");
  if (!is_viscoelastic && !scene.impact.restitution)
    values.refuse("impact.law", "given with impact.restitution, the coefficient that it relates");
}

/// A restitution takes the place of a file's viscoelastic law, and that law of a file's restitution.
void make_room_for_law(SceneValues& values, const std::vector<SceneOverride>& overrides) {
  const SceneOverride *const law = given(overrides, "impact.law"), *const restitution =
                                                                       given(overrides, "impact.restitution");
  const bool computes = law && law->text == "viscoelastic";
  if (computes && restitution) {
    throw BadInput("{} {} and {} {}: give one of them, not both", law->flag, law->text, restitution->flag,
                   restitution->text);
  }
  if (computes) values.drop("impact.restitution");
  const bool file_computes = !law && values.has("impact.law") && values.text("impact.law") == "viscoelastic";
  if (restitution && file_computes) values.drop("impact.law");
}

/// A mesh that a flag gives is the body, in place of the file's with its sizes.
void make_room_for_mesh(SceneValues& values, const std::vector<SceneOverride>& overrides) {
  if (!given(overrides, "body.mesh.file") || given(overrides, "body.shape")) return;
  for (const Key& key : all_keys()) {
    const std::string_view name = key.name;
    if (key.is_of_body() && name != "body.mass" && name != "body.mesh.density" && name != "body.merge")
      values.drop(key.name);
  }
  values.drop("drop.orientation");
  values.set("body.shape", "--mesh", "mesh");
}

Scene read_values(SceneValues values, const std::vector<SceneOverride>& overrides, Model model,
                  Motion of_scene = Motion::required) {
  values.call_by(key_flags());
  for (const Alternative& pair : alternatives()) refuse_both(overrides, pair.instead_of, pair.key);
  refuse_both(overrides, "run.tolerance", "run.step");
  make_room_for_law(values, overrides);
  make_room_for_mesh(values, overrides);
  if (given(overrides, "ground.curve") && values.has("ground.modulus")) values.drop("ground.body_material");
  for (const SceneOverride& flag : overrides) {
    for (const Alternative& pair : alternatives()) {
      if (flag.key == pair.key) values.drop(pair.instead_of);
      if (flag.key == pair.instead_of) values.drop(pair.key);
    }
    if (flag.key == "drop.start" && flag.text == "rest") {
      for (const char* const motion : motions_before_touch) values.drop(motion);
    }
    if (flag.key == "run.method") values.drop(flag.text == "tvd-rk3" ? "run.tolerance" : "run.step");
    if (flag.key == "run.step") values.drop("run.tolerance");
    if (flag.key == "run.tolerance") values.drop("run.step");
    if (flag.key == "drop.angle_deg" || flag.key == "drop.attitude" || flag.key == "drop.orientation")
      drop_sweep(values, "angle_deg");
    values.set(flag.key, flag.flag, flag.text);
  }
  values.name_numbers("body.mesh.unit", {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"in", 0.0254}});
  Scene scene = default_scene(values);
  scene.sweep = read_sweep_table(values);
  for (const Alternative& pair : alternatives()) values.exclude(pair.instead_of, pair.key);
  put_values(values, scene, model);
  check_sweep(values, scene);
  check_start(values, scene, model);
  check_drop(values, scene, of_scene);
  check_accuracy(values, scene.accuracy);
  values.exclude("impact.impulse_ratio", "impact.friction");
  check_body(values, scene.body);
  check_ground(values, scene, model);
  check_impact(values, scene);
  if (model == Model::continuous && std::isfinite(scene.request.until)) scene.request.impacts = scene.most_impacts();
  if (of_scene == Motion::required) scene.settle_restitution();
  std::ranges::sort(scene.times);
  if (!scene.times.empty() && scene.times.front() < 0 && !scene.is_released())
    values.refuse("run.at", "times from 0 on: the motion begins with the first impact where there is no drop.release");
  return scene;
}

/// Whether a source that is no file could be the name of a case.
bool is_plain_name(const std::string& source) { return source.find_first_of("./\\") == std::string::npos; }

/// The scene that has a mesh, and nothing else.
SceneValues mesh_values(const std::string& file) {
  SceneValues values(file, "[body]\nshape = \"mesh\"\n", scene_keys());
  values.set("body.mesh.file", "SCENE", file);
  return values;
}

std::string case_path(const std::string& name) { return "validation/cases/" + name + ".toml"; }

}  // namespace

void require_level(const Scene& scene, const std::string& command) {
  if (scene.world.incline_deg == 0) return;
  throw BadInput("world.incline_deg = {}: must be left out for clatter {}, whose ground is level",
                 shortest(scene.world.incline_deg), command);
}

void Scene::settle() {
  if (is_released()) {
    const auto or_none = [](const std::vector<double>& v) { return v.empty() ? std::vector<double>(3, 0.0) : v; };
    velocity = or_none(release.velocity);
    angular_velocity = or_none(release.angular_velocity);
    if (release.spin) angular_velocity[1] = *release.spin;
    if (release.angle_deg) angle_deg = std::remainder(*release.angle_deg, 360);
    if (!release.attitude.empty()) attitude = release.attitude;
  }
  if (orientation) {
    if (body.shape != BodyScene::Shape::box)
      throw BadInput("drop.orientation: must be left out where the body is no box");
    const int number = static_cast<int>(*orientation);
    if (number != *orientation)
      throw BadInput("drop.orientation = {}: must be a whole number from 1 to 26", shortest(*orientation));
    attitude = orientation_attitude(number, body.size);
  }
  if (!attitude.empty()) angle_deg = inclination_of(attitude);
  if (pad.curve.empty() && pad.file.empty()) settle_half_space(half_space, world.ground);
  else if (has_ground()) settle_pad(pad, half_space, world.ground);  // else it is not read yet
  if (!topple) return;
  const TouchMotion touch = toppled(*this);
  velocity.assign(touch.velocity.begin(), touch.velocity.end());
  angular_velocity.assign(touch.angular_velocity.begin(), touch.angular_velocity.end());
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  const std::string before = case_path(""), folder = before.substr(0, before.rfind('/') + 1);
  for (const EmbeddedFile& file : embedded_files()) {
    const std::filesystem::path path(file.name);
    if (file.name.starts_with(folder) && file.name.ends_with(".toml")) names.push_back(path.stem().string());
  }
  return names;
}

std::string_view case_text(const std::string& name) {
  const std::vector<std::string> names = case_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return embedded_text(case_path(name));
  throw BadInput("case '{}': there is none of this name{}", name, suggestion(name, names));
}

SceneValues scene_values(const std::string& source) {
  if (source.empty()) return {"", "", scene_keys()};
  if (numeric::is_surface_file(source) || numeric::is_gmsh_file(source)) return mesh_values(source);
  std::error_code error;
  if (!is_plain_name(source) || std::filesystem::exists(source, error)) return {source, scene_keys()};
  const std::vector<std::string> names = case_names();
  if (std::find(names.begin(), names.end(), source) != names.end())
    return {case_path(source), case_text(source), scene_keys()};
  throw BadInput("{}: neither a file nor a case{}", source, suggestion(source, names));
}

std::string name_of_source(const std::string& path) {
  const std::string name = std::filesystem::path(path).stem().string();
  const std::vector<std::string> names = case_names();
  if (path != case_path(name) || std::find(names.begin(), names.end(), name) == names.end()) return path;
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return !file.is_open() || text == case_text(name) ? name : path;
}

Scene read_scene(const SceneValues& values, const std::vector<SceneOverride>& overrides, Model model) {
  return read_values(values, overrides, model);
}

Scene read_scene_of_any_motion(const SceneValues& values, const std::vector<SceneOverride>& overrides, Model model) {
  Scene scene = read_values(values, overrides, model, Motion::left_open);
  try {
    scene.settle_restitution();
  } catch (const BadInput&) {  // which the run will tell
  }
  return scene;
}

Scene read_scene(const std::string& source, const std::vector<SceneOverride>& overrides, Model model) {
  return read_values(scene_values(source), overrides, model);
}

Scene case_scene(const std::string& name, const std::vector<SceneOverride>& overrides) {
  return read_values({case_path(name), case_text(name), scene_keys()}, overrides, Model::continuous);
}

}  // namespace clatter::validation
