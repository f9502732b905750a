// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that go between the page of `clatter demo`, its address and files.
#pragma once

#include <string>
#include <vector>

#include "validation/output/value.hpp"
#include "validation/scene/named_texts.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline demo {

/// A scene as the arguments that give it: {"body": "box", "size": [L, W, T], "angle": 10, …}.  Keys that have the value
/// of flags alone are left out, but for the body's and for gravity.
struct SceneArguments {
  Value::Fields arguments;
  std::vector<std::string> notes;  ///< what the arguments say that the scene does not, or do not say, a line each
};

/// @throws BadInput for what the page does not draw: a mesh, a round body, a sweep
void require_shown(const Scene& scene);

/// The scene as it is, with the law that the discrete model takes.  @throws as require_shown
[[nodiscard]] SceneArguments scene_arguments(const Scene& scene);

/// The fragment of the page's address for a scene: "given=1&body=box&angle=10…", numbers shortest round-trip.
/// @throws as require_shown
[[nodiscard]] std::string page_fragment(const Scene& scene);

/// The arguments of a file's text; `name` is what messages call the file.  A file without a ground is one of the
/// discrete model.  @throws BadInput "name:line:column: …" as read_scene.
[[nodiscard]] SceneArguments opened_scene(const std::string& name, const std::string& text);

/// The scene that the arguments give, as the text of a file: read again it gives the same arguments.
/// @throws BadInput as read_scene
[[nodiscard]] std::string scene_file(NamedTexts arguments);

}  // namespace clatter::validation::inline demo
