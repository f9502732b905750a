// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/scene_exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "analytic/law/viscoelastic.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/output/version.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation::inline demo {
namespace {

// The paper's mesh: with it the page simulates a rod whose radius is 0.
constexpr double simulated_radius = 0.01;
constexpr std::array impact_keys{"impact.restitution", "impact.law", "impact.impulse_ratio", "impact.friction"};

bool is_thin(const Scene& scene) { return scene.body.shape == BodyScene::Shape::rod && scene.body.radius == 0; }

/// What flags alone give a body of this shape.
Scene bare_scene(BodyScene::Shape shape) {
  Scene scene;
  scene.body.shape = shape;
  scene.world.ground.stiffness = 0;
  scene.world.gravity = 0;
  return scene;
}

bool is_always_said(const Key& key) {
  constexpr std::array names{"body.shape", "body.mass", "body.length", "body.radius", "body.size", "world.gravity",
                             // Said, since a ground gives another where no impact.* key stands.
                             "impact.restitution"};
  return std::find(names.begin(), names.end(), std::string_view(key.name)) != names.end();
}

/// The keys that the scene has to say, in the order of the echo.
std::vector<const Key*> said_keys(const Scene& scene) {
  const Scene bare = bare_scene(scene.body.shape);
  std::vector<const Key*> said;
  for (const Key& key : all_keys()) {
    const Json value = key.get(scene);
    if (key.is_file() || value.is_null()) continue;
    if (is_always_said(key) || key.is_required || value != key.get(bare)) said.push_back(&key);
  }
  return said;
}

void require_shown(const Scene& scene) {
  if (scene.body.shape == BodyScene::Shape::mesh)
    throw BadInput("body.shape 'mesh': must be rod or box; a page can name no file");
  if (scene.sweep) throw BadInput("sweep: must be left out; the page shows one drop, and this scene sweeps a quantity");
}

/// Downward, of the centre of mass at the first touch [m/s].
double touch_speed(Scene scene) {
  if (!scene.height) return -scene.touch_velocity().z();
  if (is_thin(scene)) scene.body.radius = simulated_radius;
  return -scene.start(scene.make_body()).velocity.z();
}

/// Restitution and friction that the ground gives the first impact, as in `clatter compare`.
void take_impact_of_ground(Scene& scene) {
  const double per_speed = scene.world.ground.damping / scene.world.ground.stiffness;
  scene.impact.restitution = analytic::restitution_of_damping(per_speed * touch_speed(scene));
  if (scene.world.ground.has_friction()) scene.impact.friction = scene.world.ground.sliding_friction;
}

SceneArguments arguments_of(Scene scene, bool has_impact) {
  require_shown(scene);
  SceneArguments result;
  const bool is_of_ground = scene.world.ground.stiffness > 0 && !has_impact;
  if (is_of_ground && (scene.world.ground.damping > 0 || scene.world.ground.has_friction())) {
    take_impact_of_ground(scene);
    result.notes.emplace_back("restitution and friction of the discrete model are those of the ground, at impact 1");
  }
  if (!scene.history.empty()) result.notes.emplace_back("run.history is left out: a page writes no file");
  for (const Key* key : said_keys(scene)) result.arguments.push_back({key->argument(), value_of(key->get(scene))});
  return result;
}

/// Reads `values` for the model that they are for; no simulation takes a rod without thickness, but the page does.
Scene read_for_page(SceneValues values, const std::vector<SceneOverride>& overrides) {
  constexpr Range any{-1e300, 1e300, false, "at least 0"};
  std::vector<SceneOverride> others = overrides;
  bool thin = values.has("body.radius") && values.number("body.radius", 1, any) == 0;
  if (thin) values.drop("body.radius");
  bool has_ground = values.has("ground.stiffness");
  std::erase_if(others, [&](const SceneOverride& given) {
    double number = 1;
    const bool is_none = given.key == "body.radius" && read_number(given.text, number) && number == 0;
    has_ground |= given.key == "ground.stiffness";
    thin |= is_none;
    return is_none;
  });
  Scene scene = read_scene(values, others, has_ground ? Model::continuous : Model::discrete);
  if (thin) scene.body.radius = 0;
  return scene;
}

std::string line_of(const Key& key, const Scene& scene) {
  const std::string name = std::string(key.name).substr(std::string_view(key.name).find('.') + 1);
  const std::string unit = *key.unit == '\0' ? "" : fmt::format(" [{}]", key.unit);
  return fmt::format("{} = {}  # {}{}\n", name, compact_json(value_of(key.get(scene))), key.help, unit);
}

}  // namespace

SceneArguments scene_arguments(const Scene& scene) {
  const DiscreteImpact& impact = scene.impact;
  const bool has_impact = impact.restitution != 1 || impact.impulse_ratio || impact.friction ||
                          impact.law != analytic::RestitutionLaw::newton;
  return arguments_of(scene, has_impact);
}

SceneArguments opened_scene(const std::string& name, const std::string& text) {
  const SceneValues values(name, text, scene_keys());
  const bool has_impact =
      std::any_of(impact_keys.begin(), impact_keys.end(), [&](const char* key) { return values.has(key); });
  return arguments_of(read_for_page(values, {}), has_impact);
}

std::string scene_file(NamedTexts arguments) {
  const Scene scene = read_for_page(SceneValues("", "", scene_keys()), scene_overrides(arguments));
  require_shown(scene);
  std::string text =
      fmt::format("# A scene of clatter {}: clatter sequence FILE, simulate FILE, compare FILE.\n", version);
  if (is_thin(scene))
    text += fmt::format("# simulate and compare need a radius: the page took --radius {}.\n", simulated_radius);
  std::string table;
  for (const Key* key : said_keys(scene)) {
    const std::string name = key->name, its_table = name.substr(0, name.find('.'));
    if (its_table != table) text += fmt::format("\n[{}]\n", its_table);
    table = its_table;
    text += line_of(*key, scene);
  }
  return text;
}

}  // namespace clatter::validation::inline demo
