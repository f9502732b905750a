#include "validation/cli/scene_flags.hpp"

#include "validation/cli/options.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

/// Keys that a flag overrides.
std::vector<const Key*> flag_keys() {
  std::vector<const Key*> keys;
  for (const Key& key : all_keys()) {
    if (key.flag[0] != '\0') keys.push_back(&key);
  }
  return keys;
}

}  // namespace

void add_scene_argument(Command& command, std::string& file) {
  command.add({.name = "SCENE", .target = &file, .type = "FILE", .help = "scene file (TOML)", .required = true});
}

void add_scene_flags(Command& command, SceneFlags& given) {
  const char* const group = "Scene (each overrides its key in the file)";
  add_scene_argument(command, given.file);
  for (const Key* key : flag_keys()) {
    if (key->is_truth()) command.add_flag(key->flag, given.truths[key->flag], key->help, group);
    else command.add_text(key->flag, given.texts[key->flag], key->type, key->help, group);
  }
}

SimulationScene read_scene_flags(const SceneFlags& given) {
  std::vector<SceneOverride> overrides;
  for (const Key* key : flag_keys()) {
    const std::string flag = key->flag;
    if (!key->is_truth()) {
      if (const auto& text = given.texts.at(flag)) overrides.push_back({key->name, flag, *text});
    } else if (given.truths.at(flag)) {
      overrides.push_back({key->name, flag, flag.starts_with("--no-") ? "false" : "true"});
    }
  }
  return read_simulation_scene(given.file, overrides);
}

bool is_given(const SceneFlags& given, const std::string& name) { return given.texts.at(name).has_value(); }

std::vector<RunFile> files_of(const SimulationScene& scene) {
  return {{"the scene file", scene.path}, {"the mesh file", scene.body.file}};
}

}  // namespace clatter::validation
