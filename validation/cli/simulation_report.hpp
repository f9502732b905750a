// A run of the continuous model as a table and as JSON.
#pragma once

#include <vector>

#include "validation/output/json.hpp"
#include "validation/output/table.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

[[nodiscard]] Table simulation_table(const Scene& scene, const PlannedRun& planned);
[[nodiscard]] Json simulation_json(const Scene& scene, const PlannedRun& planned);
/// One row per impact with the JSON's names as columns.
[[nodiscard]] Table simulation_records(const Scene& scene, const PlannedRun& planned);

/// A sweep: the scene with its value and its run, one after the other.
struct SweptRun {
  double value;
  Scene scene;
  PlannedRun planned;
};
/// The first impact of each, one row a value.
[[nodiscard]] Table sweep_table(const Scene& scene, const std::vector<SweptRun>& runs);
[[nodiscard]] Json sweep_json(const Scene& scene, const std::vector<SweptRun>& runs);
/// All impacts of each, with the swept value in the first column.
[[nodiscard]] Table sweep_records(const Scene& scene, const std::vector<SweptRun>& runs);

}  // namespace clatter::validation
