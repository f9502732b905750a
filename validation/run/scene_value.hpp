// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as the head and the fields of a report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/output/value.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// All keys that the model has, defaults included, under the names of the file; for the discrete model, or with
/// `approach`, also "discrete_law": the law that it takes and where each number came from (law_fields).
/// @param approach  speed of the first contact in the discrete model [m/s]
[[nodiscard]] Value scene_value(const Scene& scene, Model model = Model::continuous,
                                std::optional<double> approach = {});

/// "scene: {…}", the same as one line of JSON.
[[nodiscard]] std::string scene_line(const Scene& scene, Model model = Model::continuous);

/// The head of a table: the scene's summary, a line of body_words(), and one of law_words() where scene_value has them.
/// It leaves out what `unsettled` keys say, and the body's numbers where they are not those of one body.
[[nodiscard]] std::vector<std::string> scene_head(const Scene& scene, Model model = Model::continuous,
                                                  std::optional<double> approach = {}, const KeyNames& unsettled = {});

}  // namespace clatter::validation
