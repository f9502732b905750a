// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/scene_flags.hpp"

#include "validation/cli/options.hpp"
#include "validation/scene/discrete_scene.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation::inline cli {
namespace {

/// Keys that a flag overrides.
std::vector<const Key*> flag_keys(Model model) {
  std::vector<const Key*> keys;
  for (const Key& key : all_keys()) {
    if (key.flag[0] != '\0' && key.is_for(model)) keys.push_back(&key);
  }
  return keys;
}

std::vector<SceneOverride> overrides_of(const SceneFlags& given) {
  std::vector<SceneOverride> overrides;
  for (const Key* key : flag_keys(given.model)) {
    const std::string flag = key->flag;
    if (!key->is_truth()) {
      if (const auto& text = given.texts.at(flag)) overrides.push_back({key->name, flag, *text});
    } else if (given.truths.at(flag)) {
      overrides.push_back({key->name, flag, flag.starts_with("--no-") ? "false" : "true"});
    }
  }
  return overrides;
}

}  // namespace

void add_scene_argument(Command& command, std::string& source, bool required) {
  command.add({.name = "SCENE",
               .target = &source,
               .type = "FILE",
               .help = "scene file (TOML), or the name of a case",
               .required = required});
}

void add_scene_flags(Command& command, SceneFlags& given, Model model) {
  const char* const group = "Scene (alone, or each in place of its key in SCENE)";
  given.model = model;
  add_scene_argument(command, given.source, false);
  for (const Key* key : flag_keys(model)) {
    if (key->is_truth()) command.add_flag(key->flag, given.truths[key->flag], key->help, group);
    else command.add_text(key->flag, given.texts[key->flag], key->type, key->help, group);
  }
}

Scene read_scene_flags(const SceneFlags& given) {
  const SceneValues values = scene_values(given.source);
  if (given.model == Model::discrete) return read_discrete_scene(values, overrides_of(given));
  return read_scene(values, overrides_of(given), given.model);
}

bool is_given(const SceneFlags& given, const std::string& name) { return given.texts.at(name).has_value(); }

}  // namespace clatter::validation::inline cli
