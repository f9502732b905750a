// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as the head and the fields of a report, and what reports over its sweep share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/output/plot.hpp"
#include "validation/output/report.hpp"
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

/// A report on a scene with its title, head and, in JSON, the model's name, scene and body.
[[nodiscard]] Report scene_report(const std::string& command, const std::string& what, const char* model_name,
                                  const Scene& scene, Model model = Model::continuous,
                                  std::optional<double> approach = {});

/// Column of the swept values, named like the quantity.
[[nodiscard]] Column swept_column(const SceneSweep& sweep);

/// The quantity in words, for an axis of a picture, without the unit.
[[nodiscard]] std::string swept_words(const SceneSweep& sweep);
/// Range of such an axis from the first to the last value; around a single one.
[[nodiscard]] Range2 swept_range(double first, double last);

/// Adds a note if fewer values than the sweep has are done.
void add_interruption(const SceneSweep& sweep, std::size_t done, Report& report);

}  // namespace clatter::validation
