// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that go between the page of `clatter demo` and files: opened as arguments of the API, given back as a file.
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

/// The scene as it is, with the law that the discrete model takes.  @throws BadInput for a mesh or a sweep
[[nodiscard]] SceneArguments scene_arguments(const Scene& scene);

/// The same of a file's text; `name` is what messages call the file.  A file without a ground is one of the discrete
/// model.  @throws BadInput "name:line:column: …" as read_scene.
[[nodiscard]] SceneArguments opened_scene(const std::string& name, const std::string& text);

/// The scene that the arguments give, as the text of a file: read again it gives the same arguments.
/// @throws BadInput as read_scene
[[nodiscard]] std::string scene_file(NamedTexts arguments);

}  // namespace clatter::validation::inline demo
