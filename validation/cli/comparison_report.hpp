// A comparison of both models as a table and as JSON.
#pragma once

#include <vector>

#include "validation/compare/comparison.hpp"
#include "validation/output/json.hpp"
#include "validation/output/table.hpp"

namespace clatter::validation {

[[nodiscard]] Table comparison_table(const SimulationScene& scene, const Comparison& comparison);
[[nodiscard]] Json comparison_json(const SimulationScene& scene, const Comparison& comparison);
/// One row per impact and number with the JSON's names as columns.
[[nodiscard]] Table comparison_records(const SimulationScene& scene, const Comparison& comparison);

/// One value of a swept scene.
struct SweptComparison {
  double value;
  Comparison comparison;
};
/// One row per value and impact: the worst number of each.
[[nodiscard]] Table swept_comparison_table(const SimulationScene& scene, const std::vector<SweptComparison>& swept);
[[nodiscard]] Json swept_comparison_json(const SimulationScene& scene, const std::vector<SweptComparison>& swept);
[[nodiscard]] Table swept_comparison_records(const SimulationScene& scene, const std::vector<SweptComparison>& swept);

}  // namespace clatter::validation
