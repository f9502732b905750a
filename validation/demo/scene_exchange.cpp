// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/scene_exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/output/version.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation::inline demo {
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
  return std::find(names.begin(), names.end(), std::string_view(key.name)) != names.end();
}

/// The keys that the scene has to say, in the order of the echo.
std::vector<const Key*> said_keys(const Scene& scene) {
  const Scene bare = bare_scene(scene.body.shape);
  std::vector<const Key*> said;
  for (const Key& key : all_keys()) {
    const Value value = key.get(scene);
    if (key.is_file() || value.is_nothing()) continue;
    if (is_always_said(key) || key.is_required || compact_json(value) != compact_json(key.get(bare)))
      said.push_back(&key);
  }
  return said;
}

}  // namespace

void require_shown(const Scene& scene) {
  if (scene.body.shape == BodyScene::Shape::mesh)
    throw BadInput("body.shape 'mesh': must be rod or box; a page can name no file");
  if (scene.body.is_round()) throw BadInput("body.shape: must be rod or box; the page draws no other shape");
  if (scene.sweep) throw BadInput("sweep: must be left out; the page shows one drop, and this scene sweeps a quantity");
}

SceneArguments scene_arguments(const Scene& scene) {
  require_shown(scene);
  SceneArguments result;
  if (!scene.history.empty()) result.notes.emplace_back("run.history is left out: a page writes no file");
  for (const Key* key : said_keys(scene)) result.arguments.push_back({key->argument(), key->get(scene)});
  return result;
}

namespace {

/// A list as flags have it, numbers with commas between; in an address "+" means a blank.
std::string text_of(const Value& value) {
  const auto* const list = std::get_if<Value::List>(&value.content());
  std::string text = list ? "" : value.text();
  for (const Value& part : list ? *list : Value::List{}) text += (text.empty() ? "" : ",") + part.text();
  for (std::size_t at = 0; (at = text.find('+', at)) != std::string::npos;) text.replace(at, 1, "%2B");
  return text;
}

/// Reads `values` for the model that they are for.
Scene read_for_page(const SceneValues& values, const std::vector<SceneOverride>& overrides) {
  const bool has_ground = values.has("ground.stiffness") ||
                          std::any_of(overrides.begin(), overrides.end(),
                                      [](const SceneOverride& given) { return given.key == "ground.stiffness"; });
  return read_scene(values, overrides, has_ground ? Model::continuous : Model::discrete);
}

std::string line_of(const Key& key, const Scene& scene) {
  const std::string name = std::string(key.name).substr(std::string_view(key.name).find('.') + 1);
  const std::string unit = *key.unit == '\0' ? "" : fmt::format(" [{}]", key.unit);
  return fmt::format("{} = {}  # {}{}\n", name, compact_json(key.get(scene)), key.help, unit);
}

}  // namespace

std::string page_fragment(const Scene& scene) {
  std::string fragment = "given=1";
  for (const Field& argument : scene_arguments(scene).arguments)
    fragment += "&" + argument.name + "=" + text_of(argument.value);
  return fragment;
}

SceneArguments opened_scene(const std::string& name, const std::string& text) {
  return scene_arguments(read_for_page(SceneValues(name, text, scene_keys()), {}));
}

std::string scene_file(NamedTexts arguments) {
  const Scene scene = read_for_page(SceneValues("", "", scene_keys()), scene_overrides(arguments));
  require_shown(scene);
  std::string text =
      fmt::format("# A scene of clatter {}: clatter sequence FILE, simulate FILE, compare FILE.\n", version);
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
