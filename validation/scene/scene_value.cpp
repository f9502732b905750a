// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/scene_value.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "validation/output/json.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation::inline scene {

Value scene_value(const Scene& scene, Model model, std::optional<double> approach) {
  Value fields = value_of(scene.json(model));
  if (model == Model::discrete || approach) fields["discrete_law"] = law_fields(scene, approach);
  return fields;
}

std::string scene_line(const Scene& scene, Model model) { return "scene: " + compact_json(scene_value(scene, model)); }

std::vector<std::string> scene_head(const Scene& scene, Model model, std::optional<double> approach) {
  std::vector<std::string> head = scene.summary(model);
  head.insert(head.begin() + 1, body_words(scene, model));
  if (model == Model::discrete) {
    head.push_back(fmt::format("impact: {}; at most {} impacts, {} digits", law_words(scene, approach),
                               scene.request.impacts, scene.accuracy.digits));
  } else if (approach) {
    head.push_back("discrete model: " + law_words(scene, approach));
  }
  return head;
}

}  // namespace clatter::validation::inline scene
