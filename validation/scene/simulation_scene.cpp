#include "validation/scene/simulation_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "numeric/mesh/generators.hpp"
#include "numeric/mesh/import.hpp"
#include "numeric/motion/free_flight.hpp"
#include "numeric/touch_point.hpp"
#include "validation/embedded/embedded.hpp"
#include "validation/output/names.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/bad_input.hpp"
#include "validation/scene/scene_values.hpp"

namespace clatter::validation {
namespace {

using numeric::AreaMeasure;
using numeric::FrictionLaw;
using numeric::Method;

constexpr double largest = std::numeric_limits<double>::max();
constexpr double degree = std::numbers::pi / 180;
constexpr Range any{-largest, largest, false, "finite"};
constexpr Range positive{0, largest, true, "greater than 0"};
constexpr Range not_negative{0, largest, false, "at least 0"};
constexpr Range size_range{1e-100, 1e100, false, "from 1e-100 to 1e100"};
constexpr Range thin_range{0, 1e100, false, "from 0 to 1e100"};
constexpr Range mass_range{1e-100, 1e100, false, "from 1e-100 to 1e100"};
constexpr Range speed_range{0, 1e9, true, "greater than 0 and at most 1e9"};
constexpr Range velocity_range{-1e9, 1e9, false, "from -1e9 to 1e9"};
constexpr Range gravity_range{0, 1e9, false, "from 0 to 1e9"};
constexpr Range height_range{0, 1e12, true, "greater than 0 and at most 1e12"};
constexpr Range angle_range{0, 90, false, "from 0 to 90 degrees"};

const std::vector<std::string> shape_names{"rod", "box", "mesh"};
const std::vector<std::string> law_names{"newton", "poisson", "stronge"};
const std::vector<std::string> area_names{"surface", "projected"};
const std::vector<std::string> friction_law_names{"coulomb", "regularised", "local"};
const std::vector<std::string> method_names{"auto", "tvd-rk3", "rk4", "rkf45", "rkck", "rk8pd"};
const std::vector<std::string> sweep_names{"angle_deg", "sliding_friction"};

const std::vector<std::string> known_keys{
    "drop.angle_deg", "drop.tilt_deg", "drop.speed", "drop.height", "drop.tangential_velocity", "drop.spin",
    "world.gravity",
    "impact.restitution", "impact.law", "impact.impulse_ratio", "impact.friction",
    "body.shape", "body.mass", "body.length", "body.radius", "body.size", "body.merge", "body.inertia", "body.centre",
    "body.mesh.sectors", "body.mesh.rings", "body.mesh.layers", "body.mesh.nx", "body.mesh.ny", "body.mesh.nz",
    "body.mesh.file", "body.mesh.unit", "body.mesh.density",
    "ground.stiffness", "ground.damping", "ground.static_friction", "ground.sliding_friction", "ground.area",
    "ground.friction_law", "ground.regularisation_speed",
    "run.impacts", "run.digits", "run.require_digits", "run.method", "run.tolerance", "run.step", "run.history", "run.planar",
    "run.contact_gravity", "run.evaluation_limit",
    "run.errors", "run.amplification",
    "sweep.angle_deg.from", "sweep.angle_deg.to", "sweep.angle_deg.step",
    "sweep.sliding_friction.from", "sweep.sliding_friction.to", "sweep.sliding_friction.step"};

bool is_stl(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ".stl";
}

void only_for(const SceneValues& values, const std::vector<std::string>& keys, const std::string& what) {
  for (const std::string& key : keys) {
    if (values.has(key)) values.refuse(key, "left out: it is only for " + what);
  }
}

int count(const SceneValues& values, const std::string& key, int fallback, int low) {
  return static_cast<int>(values.integer(key, fallback, low, 100'000));
}

void read_rod(const SceneValues& values, BodyScene& body, Model model) {
  body.length = values.number("body.length", body.length, size_range);
  body.radius = values.number("body.radius", body.radius, model == Model::discrete ? thin_range : size_range);
  body.sectors = count(values, "body.mesh.sectors", body.sectors, 3);
  body.rings = count(values, "body.mesh.rings", body.rings, 1);
  body.layers = count(values, "body.mesh.layers", body.layers, 1);
}

void read_box(const SceneValues& values, BodyScene& body) {
  values.require("body.size", "the box's [L, W, T] in m");
  const auto size = values.numbers("body.size", {3}, size_range, "three lengths in m greater than 0, as in [0.106, 0.044, 0.019]");
  body.size = {size[0], size[1], size[2]};
  body.nx = count(values, "body.mesh.nx", body.nx, 1);
  body.ny = count(values, "body.mesh.ny", body.ny, 1);
  body.nz = count(values, "body.mesh.nz", body.nz, 1);
}

void read_mesh(const SceneValues& values, BodyScene& body) {
  values.require("body.mesh.file", "a Gmsh or STL file");
  const std::filesystem::path file = values.text("body.mesh.file");
  body.file = (file.is_absolute() ? file : std::filesystem::path(values.path()).parent_path() / file).string();
  body.unit = values.number("body.mesh.unit", 1, positive);
  if (is_stl(body.file)) {
    only_for(values, {"body.mesh.density"}, "a Gmsh file");
    values.require("body.mass", "an STL surface has none");
    values.require("body.inertia", "an STL surface has none");
    body.inertia = values.numbers("body.inertia", {3, 6}, any,
                                  "three principal moments in kg m2, or six numbers xx, yy, zz, xy, xz, yz");
    body.centre = values.numbers("body.centre", {3}, any, "three coordinates in the file's unit");
    if (body.centre.empty()) body.centre = {0, 0, 0};
    return;
  }
  only_for(values, {"body.inertia", "body.centre"}, "an STL file");
  values.exclude("body.mass", "body.mesh.density");
  if (values.has("body.mesh.density")) body.density = values.number("body.mesh.density", 1, positive);
}

void refuse_both(const std::vector<SceneOverride>& overrides, const char* first, const char* second) {
  const auto of = [&](const char* key) {
    return std::find_if(overrides.begin(), overrides.end(), [&](const SceneOverride& o) { return o.key == key; });
  };
  const auto one = of(first), other = of(second);
  if (one == overrides.end() || other == overrides.end()) return;
  throw BadInput(fmt::format("{} and {}: give one of them, not both", one->flag, other->flag));
}

BodyScene read_body(const SceneValues& values, Model model) {
  BodyScene body;
  body.shape = static_cast<BodyScene::Shape>(values.name("body.shape", 0, shape_names));
  body.mass = values.number("body.mass", body.mass, mass_range);
  body.merge = values.truth("body.merge", true);
  if (body.shape != BodyScene::Shape::rod) {
    only_for(values, {"body.length", "body.radius", "body.mesh.sectors", "body.mesh.rings", "body.mesh.layers"}, "a rod");
  }
  if (body.shape != BodyScene::Shape::box) {
    only_for(values, {"body.size", "body.mesh.nx", "body.mesh.ny", "body.mesh.nz"}, "a box");
  }
  if (body.shape != BodyScene::Shape::mesh) {
    only_for(values, {"body.mesh.file", "body.mesh.unit", "body.mesh.density", "body.inertia", "body.centre"}, "a mesh");
  }
  switch (body.shape) {
    case BodyScene::Shape::rod: read_rod(values, body, model); break;
    case BodyScene::Shape::box: read_box(values, body); break;
    case BodyScene::Shape::mesh: read_mesh(values, body); break;
  }
  return body;
}

numeric::Ground read_ground(const SceneValues& values, Model model) {
  if (model == Model::continuous) values.require("ground.stiffness", "k_G in N/m3");
  numeric::Ground ground;
  ground.stiffness = values.number("ground.stiffness", 0, positive);
  ground.damping = values.number("ground.damping", 0, not_negative);
  // One coefficient given is both.
  const bool only_static = values.has("ground.static_friction") && !values.has("ground.sliding_friction");
  ground.sliding_friction =
      values.number(only_static ? "ground.static_friction" : "ground.sliding_friction", 0, not_negative);
  ground.static_friction = values.number("ground.static_friction", ground.sliding_friction, not_negative);
  if (!(ground.static_friction >= ground.sliding_friction)) {
    values.refuse("ground.static_friction",
                  fmt::format("at least ground.sliding_friction, {}", shortest(ground.sliding_friction)));
  }
  ground.area = static_cast<AreaMeasure>(values.name("ground.area", 0, area_names));
  ground.friction = static_cast<FrictionLaw>(values.name("ground.friction_law", 0, friction_law_names));
  ground.regularisation_speed =
      values.number("ground.regularisation_speed", ground.regularisation_speed, positive);
  return ground;
}

numeric::Options read_options(const SceneValues& values) {
  numeric::Options options;
  options.gravity = values.number("world.gravity", 9.81, gravity_range);
  options.impacts = static_cast<int>(values.integer("run.impacts", 6, 1, 1'000'000));
  options.digits = static_cast<int>(values.integer("run.digits", 6, 2, 12));
  options.method = static_cast<Method>(values.name("run.method", 0, method_names));
  options.step = values.number("run.step", 0, positive);
  const bool takes_step = options.method == Method::automatic || options.method == Method::tvd_rk3;
  if (values.has("run.step") && !takes_step) {
    values.refuse("run.step", fmt::format("left out: {} chooses its own", method_name(options.method)));
  }
  options.tolerance = values.number("run.tolerance", 0, {numeric::least_tolerance, 0.1, false, "from 5e-14 to 0.1"});
  if (values.has("run.tolerance") && (options.step > 0 || options.method == Method::tvd_rk3)) {
    values.refuse("run.tolerance", "left out: a fixed step has none");
  }
  options.planar = values.truth("run.planar", false);
  options.gravity_in_contact = values.truth("run.contact_gravity", true);
  options.evaluation_limit = values.integer("run.evaluation_limit", options.evaluation_limit, 1, 1'000'000'000'000);
  options.error_estimates = values.truth("run.errors", true);
  options.amplification = values.truth("run.amplification", true);
  return options;
}

DiscreteImpact read_impact(const SceneValues& values) {
  DiscreteImpact impact;
  values.exclude("impact.impulse_ratio", "impact.friction");
  impact.restitution = values.number("impact.restitution", 1, {0, 1, false, "from 0 to 1"});
  impact.law = law_names[values.name("impact.law", 0, law_names)];
  if (values.has("impact.impulse_ratio")) impact.impulse_ratio = values.number("impact.impulse_ratio", 0, any);
  if (values.has("impact.friction")) impact.friction = values.number("impact.friction", 0, not_negative);
  return impact;
}

std::optional<SceneSweep> read_sweep_table(const SceneValues& values) {
  std::optional<SceneSweep> sweep;
  for (std::size_t i = 0; i < sweep_names.size(); ++i) {
    const std::string table = "sweep." + sweep_names[i];
    if (!values.has_table(table)) continue;
    if (sweep) throw BadInput(fmt::format("{}: {}: only one quantity can be swept", values.path(), table));
    const Range& range = i == 0 ? angle_range : not_negative;
    for (const char* key : {".from", ".to", ".step"}) values.require(table + key, "a sweep has from, to and step");
    sweep = SceneSweep{static_cast<SceneSweep::Quantity>(i), values.number(table + ".from", 0, range),
                       values.number(table + ".to", 0, range), values.number(table + ".step", 1, positive)};
    if (!(sweep->to >= sweep->from)) values.refuse(table + ".to", "at least the sweep's from");
    if (!((sweep->to - sweep->from) / sweep->step <= 1e6)) values.refuse(table + ".step", "at most 1000000 values");
  }
  return sweep;
}

void read_drop(const SceneValues& values, SimulationScene& scene) {
  const bool swept = scene.sweep && scene.sweep->quantity == SceneSweep::Quantity::angle_deg;
  if (!swept) values.require("drop.angle_deg", "the inclination at the first impact");
  if (swept) only_for(values, {"drop.angle_deg"}, "a scene that does not sweep it");
  scene.angle_deg = swept ? scene.sweep->from : values.number("drop.angle_deg", 0, angle_range);
  scene.tilt_deg = values.number("drop.tilt_deg", 0, {-180, 180, false, "from -180 to 180 degrees"});
  values.exclude("drop.speed", "drop.height");
  scene.speed = values.number("drop.speed", 1, speed_range);
  scene.tangential_velocity = values.number("drop.tangential_velocity", 0, velocity_range);
  scene.spin = values.number("drop.spin", 0, velocity_range);
  if (!values.has("drop.height")) return;
  scene.height = values.number("drop.height", 0, height_range);
  if (!(scene.options.gravity > 0)) values.refuse("drop.height", "left out where world.gravity is 0");
}

Json list(const numeric::Vector3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json body_json(const BodyScene& body) {
  Json json{{"shape", shape_names[static_cast<std::size_t>(body.shape)]}, {"mass", body.mass}};
  switch (body.shape) {
    case BodyScene::Shape::rod:
      json["length"] = body.length;
      json["radius"] = body.radius;
      json["mesh"] = {{"sectors", body.sectors}, {"rings", body.rings}, {"layers", body.layers}};
      break;
    case BodyScene::Shape::box:
      json["size"] = list(body.size);
      json["mesh"] = {{"nx", body.nx}, {"ny", body.ny}, {"nz", body.nz}};
      break;
    case BodyScene::Shape::mesh:
      json["mesh"] = {{"file", text_json(body.file)}, {"unit", body.unit}};
      if (body.density) json["mesh"]["density"] = *body.density;
      if (!body.inertia.empty()) json["inertia"] = body.inertia;
      if (!body.centre.empty()) json["centre"] = body.centre;
  }
  json["merge"] = body.merge;
  return json;
}

numeric::MassProperties stl_properties(const BodyScene& body) {
  numeric::MassProperties properties{body.mass, {body.centre[0], body.centre[1], body.centre[2]}, {}};
  properties.centre *= body.unit;
  const std::vector<double>& i = body.inertia;
  properties.inertia = numeric::Vector3(i[0], i[1], i[2]).asDiagonal();
  if (i.size() == 6) {
    properties.inertia(0, 1) = properties.inertia(1, 0) = i[3];
    properties.inertia(0, 2) = properties.inertia(2, 0) = i[4];
    properties.inertia(1, 2) = properties.inertia(2, 1) = i[5];
  }
  return properties;
}

/// With a mass instead of a density the mesh's own is scaled.
numeric::Body gmsh_body(const BodyScene& body) {
  numeric::Mesh mesh = numeric::read_gmsh(body.file, body.density.value_or(1), body.unit);
  if (!body.density) {
    const double factor = body.mass / numeric::mass_properties(mesh).mass;
    for (numeric::Element& element : mesh.elements) element.density *= factor;
  }
  return numeric::Body(mesh, body.merge);
}

std::string body_words(const BodyScene& body) {
  switch (body.shape) {
    case BodyScene::Shape::rod:
      return fmt::format("rod {} m, radius {} m, {} kg; {} elements ({} sectors, {} rings, {} layers)",
                         shortest(body.length), shortest(body.radius), shortest(body.mass),
                         static_cast<long long>(body.sectors) * body.rings * body.layers, body.sectors, body.rings,
                         body.layers);
    case BodyScene::Shape::box:
      return fmt::format("box {} × {} × {} m, {} kg; {} × {} × {} elements", shortest(body.size.x()),
                         shortest(body.size.y()), shortest(body.size.z()), shortest(body.mass), body.nx, body.ny,
                         body.nz);
    case BodyScene::Shape::mesh: break;
  }
  return fmt::format("mesh {}", body.file);
}

/// 1e11 instead of 100000000000.
std::string in_powers(double value) {
  if (value != 0 && (value >= 1e6 || value < 1e-4)) {
    const std::string digits = shortest(value / std::pow(10, std::floor(std::log10(value))));
    const int exponent = static_cast<int>(std::floor(std::log10(value)));
    double back = 0;
    if (read_number(fmt::format("{}e{}", digits, exponent), back) && back == value) {
      return fmt::format("{}e{}", digits, exponent);
    }
  }
  return shortest(value);
}

std::string friction_words(const numeric::Ground& ground) {
  if (!ground.has_friction()) return "no friction";
  std::string law;
  if (ground.friction == FrictionLaw::regularised) {
    law = fmt::format(", regularised at {} m/s", shortest(ground.regularisation_speed));
  }
  if (ground.friction == FrictionLaw::local) law = ", each place by its own slip";
  if (ground.static_friction == ground.sliding_friction) {
    return fmt::format("friction μ = {}{}", shortest(ground.sliding_friction), law);
  }
  return fmt::format("friction μₛ = {}, μₖ = {}{}", shortest(ground.static_friction),
                     shortest(ground.sliding_friction), law);
}

}  // namespace

const char* method_name(Method method) { return method_names[static_cast<std::size_t>(method)].c_str(); }

std::vector<double> SceneSweep::values() const {
  std::vector<double> values;
  const auto last = static_cast<long long>(std::floor((to - from) / step * (1 + 1e-12) + 1e-12));
  for (long long i = 0; i <= last; ++i) {
    values.push_back(std::min(clean_step(from, step, i), to));
  }
  return values;
}

const std::string& SceneSweep::name() const { return sweep_names[static_cast<std::size_t>(quantity)]; }

namespace {

SimulationScene read_values(SceneValues values, const std::vector<SceneOverride>& overrides, Model model) {
  refuse_both(overrides, "drop.speed", "drop.height");
  refuse_both(overrides, "run.tolerance", "run.step");
  for (const SceneOverride& flag : overrides) {
    if (flag.key == "drop.speed") values.drop("drop.height");
    if (flag.key == "drop.height") values.drop("drop.speed");
    if (flag.key == "run.method") values.drop(flag.text == "tvd-rk3" ? "run.tolerance" : "run.step");
    if (flag.key == "run.step") values.drop("run.tolerance");
    if (flag.key == "run.tolerance") values.drop("run.step");
    if (flag.key == "drop.angle_deg") {
      for (const char* key : {".from", ".to", ".step"}) values.drop(std::string("sweep.angle_deg") + key);
    }
    values.set(flag.key, flag.flag, flag.text);
  }
  SimulationScene scene;
  scene.path = values.path();
  scene.sweep = read_sweep_table(values);
  scene.options = read_options(values);
  read_drop(values, scene);
  scene.impact = read_impact(values);
  scene.body = read_body(values, model);
  if (scene.sweep && scene.sweep->quantity == SceneSweep::Quantity::friction) {
    only_for(values, {"ground.static_friction", "ground.sliding_friction"}, "a scene that does not sweep it");
  }
  scene.ground = read_ground(values, model);
  scene.require_digits = values.truth("run.require_digits", false);
  if (values.has("run.history")) scene.history = values.text("run.history");
  if (scene.sweep && !scene.history.empty()) values.refuse("run.history", "left out in a sweep");
  return scene;
}

}  // namespace

SimulationScene read_simulation_scene(const std::string& path, const std::vector<SceneOverride>& overrides) {
  return read_values(SceneValues(path, known_keys), overrides, Model::continuous);
}

const std::vector<std::string>& scene_keys() { return known_keys; }

SceneValues read_scene_values(const std::string& path) { return {path, known_keys}; }

SimulationScene read_simulation_scene(const SceneValues& values, const std::vector<SceneOverride>& overrides,
                                      Model model) {
  return read_values(values, overrides, model);
}

SimulationScene case_scene(const std::string& name, const std::vector<SceneOverride>& overrides) {
  const std::string path = "validation/cases/" + name + ".toml";
  return read_values(SceneValues(path, embedded_text(path), known_keys), overrides, Model::continuous);
}

SimulationScene SimulationScene::at(double value) const {
  SimulationScene one = *this;
  if (sweep->quantity == SceneSweep::Quantity::angle_deg) one.angle_deg = value;
  else one.ground.static_friction = one.ground.sliding_friction = value;
  one.sweep.reset();
  return one;
}

numeric::Body SimulationScene::make_body() const {
  switch (body.shape) {
    case BodyScene::Shape::rod:
      return numeric::Body(numeric::rod_mesh({.length = body.length, .radius = body.radius, .mass = body.mass,
                                              .sectors = body.sectors, .rings = body.rings, .layers = body.layers}),
                           body.merge);
    case BodyScene::Shape::box:
      return numeric::Body(numeric::box_mesh({.size = body.size, .mass = body.mass, .nx = body.nx, .ny = body.ny,
                                              .nz = body.nz}),
                           body.merge);
    case BodyScene::Shape::mesh: break;
  }
  if (is_stl(body.file)) return {stl_properties(body), numeric::read_stl(body.file, body.unit), body.merge};
  return gmsh_body(body);
}

numeric::MotionState SimulationScene::start(const numeric::Body& dropped) const {
  numeric::MotionState state = numeric::touching_state(
      dropped, {.inclination = angle_deg * degree, .velocity = {tangential_velocity, 0, -speed}, .spin = spin,
                .out_of_plane_tilt = tilt_deg * degree});
  if (height) state.velocity.z() = -fallen_speed(state);
  const numeric::FirstTouch first = numeric::first_touch(dropped, state);
  if (!(first.approach_speed > 0)) {  // in the discrete model's words
    throw BadInput(fmt::format("the first contact, end {}, does not approach the ground: speed and spin must bring it down",
                               end_name(first.end)));
  }
  return state;
}

double SimulationScene::fallen_speed(const numeric::MotionState& state) const {
  const double touch = state.centre.z();
  if (!(*height > touch)) {
    throw BadInput(fmt::format("{}: drop.height = {}: must be greater than {} m, the height of the centre of mass at the first touch",
                               path, shortest(*height), significant(touch, 6)));
  }
  return std::sqrt(2 * options.gravity * (*height - touch));
}

Json SimulationScene::json() const {
  const auto or_null = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  Json json{{"file", text_json(path)},
            {"drop", {{"angle_deg", angle_deg}, {"tilt_deg", tilt_deg}, {"speed", height ? Json(nullptr) : Json(speed)},
                      {"height", or_null(height)}, {"tangential_velocity", tangential_velocity}, {"spin", spin}}},
            {"world", {{"gravity", options.gravity}}},
            {"impact", {{"restitution", impact.restitution}, {"law", impact.law},
                        {"impulse_ratio", or_null(impact.impulse_ratio)}, {"friction", or_null(impact.friction)}}},
            {"body", body_json(body)},
            {"ground", {{"stiffness", ground.stiffness > 0 ? Json(ground.stiffness) : Json(nullptr)}, {"damping", ground.damping},
                        {"static_friction", ground.static_friction}, {"sliding_friction", ground.sliding_friction},
                        {"area", area_names[static_cast<std::size_t>(ground.area)]},
                        {"friction_law", friction_law_names[static_cast<std::size_t>(ground.friction)]},
                        {"regularisation_speed", ground.regularisation_speed}}},
            {"run", {{"impacts", options.impacts}, {"digits", options.digits},
                     {"require_digits", require_digits}, {"method", method_name(options.method)},
                     {"tolerance", options.tolerance > 0 ? Json(options.tolerance) : Json(nullptr)},
                     {"step", options.step > 0 ? Json(options.step) : Json(nullptr)},
                     {"history", history.empty() ? Json(nullptr) : text_json(history)}, {"planar", options.planar},
                     {"contact_gravity", options.gravity_in_contact},
                     {"evaluation_limit", options.evaluation_limit}, {"errors", options.error_estimates},
                     {"amplification", options.amplification}}}};
  if (sweep) {
    json["sweep"][sweep->name()] = {{"from", sweep->from}, {"to", sweep->to}, {"step", sweep->step}};
  }
  return json;
}

std::vector<std::string> SimulationScene::summary() const {
  const bool sweeps_friction = sweep && sweep->quantity == SceneSweep::Quantity::friction;
  std::string drop = sweep && sweep->quantity == SceneSweep::Quantity::angle_deg
                         ? fmt::format("drop: {}° to {}°", shortest(sweep->from), shortest(sweep->to))
                         : fmt::format("drop: {}°", shortest(angle_deg));
  if (tilt_deg != 0) drop += fmt::format(", tilted by {}°", shortest(tilt_deg));
  drop += height ? fmt::format(" from {} m", shortest(*height)) : fmt::format(" at {} m/s", shortest(speed));
  if (tangential_velocity != 0) drop += fmt::format(", tangential {} m/s", shortest(tangential_velocity));
  if (spin != 0) drop += fmt::format(", spin {} rad/s", shortest(spin));
  drop += fmt::format(", gravity {} m/s²{}", shortest(options.gravity), options.planar ? ", kept in its plane" : "");
  return {body_words(body), drop,
          fmt::format("ground: k = {} N/m³, c = {} N·s/m⁴ over the {} area, {}", in_powers(ground.stiffness),
                      in_powers(ground.damping), area_names[static_cast<std::size_t>(ground.area)],
                      sweeps_friction ? fmt::format("friction μ = {} to {}", shortest(sweep->from), shortest(sweep->to))
                                      : friction_words(ground))};
}

}  // namespace clatter::validation
