// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/scene_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "validation/output/json.hpp"

namespace clatter::validation {
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
