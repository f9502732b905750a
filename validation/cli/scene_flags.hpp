// A scene file and the flags that override its keys, for the commands that take one.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "validation/scene/simulation_scene.hpp"

namespace clatter::validation {

/// What was typed; texts in the order of the flags.
struct SceneFlags {
  std::string file;
  std::vector<std::optional<std::string>> texts;
  bool planar = false, no_contact_gravity = false;
};

/// Adds SCENE and the flags.
void add_scene_flags(CLI::App& command, SceneFlags& flags);
/// @throws BadInput with one line.
[[nodiscard]] SimulationScene read_scene_flags(const SceneFlags& flags);
/// Whether the flag ("--history") was typed.
[[nodiscard]] bool is_given(const SceneFlags& flags, const std::string& name);
/// @throws BadInput if `path`, given for `option`, is the scene file itself.
void refuse_scene_file(const SceneFlags& flags, const std::string& option, const std::string& path);

}  // namespace clatter::validation
