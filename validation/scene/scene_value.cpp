// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/scene_value.hpp"

#include <fmt/format.h>

#include <algorithm>
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

std::vector<std::string> scene_head(const Scene& scene, Model model, std::optional<double> approach,
                                    const KeyNames& unsettled) {
  const auto is_settled = [&](std::string_view key) {
    return std::find(unsettled.begin(), unsettled.end(), key) == unsettled.end();
  };
  std::vector<std::string> head = scene.summary(model, unsettled);
  const bool is_one_body = std::none_of(unsettled.begin(), unsettled.end(),
                                        [](const std::string& key) { return key.starts_with("body."); });
  if (is_one_body) head.insert(head.begin() + 1, body_words(scene, model));
  if (model == Model::discrete) {
    std::string words = "impact: " + law_words(scene, approach, unsettled);
    if (is_settled("run.impacts")) words += fmt::format("; at most {} impacts", scene.request.impacts);
    if (is_settled("run.digits")) words += fmt::format(", {} digits", scene.accuracy.digits);
    head.push_back(words);
  } else if (approach) {
    head.push_back("discrete model: " + law_words(scene, approach));
  }
  return head;
}

}  // namespace clatter::validation::inline scene
