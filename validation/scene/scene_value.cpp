// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/scene_value.hpp"

#include <nlohmann/json.hpp>

#include "validation/output/json.hpp"

namespace clatter::validation::inline scene {

Value scene_value(const Scene& scene, Model model) { return value_of(scene.json(model)); }

std::string scene_line(const Scene& scene, Model model) { return "scene: " + compact_json(scene_value(scene, model)); }

}  // namespace clatter::validation::inline scene
