// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as fields of a report.
#pragma once

#include <string>

#include "validation/output/value.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline scene {

/// All keys that the model has, defaults included, as Scene::json().
[[nodiscard]] Value scene_value(const Scene& scene, Model model = Model::continuous);

/// "scene: {…}", the same as one line of JSON.
[[nodiscard]] std::string scene_line(const Scene& scene, Model model = Model::continuous);

}  // namespace clatter::validation::inline scene
