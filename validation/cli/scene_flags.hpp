// SPDX-License-Identifier: GPL-3.0-or-later
// A scene file and the flags that override its keys, for the commands that take one.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/cli/command.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline cli {

/// What was typed, by the name of the flag.
struct SceneFlags {
  std::string source;  ///< scene file or case; empty: flags alone
  Model model = Model::continuous;
  std::map<std::string, std::optional<std::string>> texts;
  std::map<std::string, bool> truths;
};

/// Adds the argument SCENE.
void add_scene_argument(Command& command, std::string& source, bool required);
/// Adds SCENE and the flags of the keys that the model has.
void add_scene_flags(Command& command, SceneFlags& flags, Model model = Model::continuous);
/// @throws BadInput with one line.
[[nodiscard]] Scene read_scene_flags(const SceneFlags& flags);
/// Whether the flag ("--history") was typed.
[[nodiscard]] bool is_given(const SceneFlags& flags, const std::string& name);

}  // namespace clatter::validation::inline cli
