// A comparison of both models as a table and as JSON.
#pragma once

#include <vector>

#include "validation/compare/comparison.hpp"
#include "validation/output/json.hpp"
#include "validation/output/table.hpp"

namespace clatter::validation {

[[nodiscard]] Table comparison_table(const Scene& scene, const Comparison& comparison);
[[nodiscard]] Json comparison_json(const Scene& scene, const Comparison& comparison);
/// One row per impact and number with the JSON's names as columns.
[[nodiscard]] Table comparison_records(const Scene& scene, const Comparison& comparison);

/// The number of an impact that deviates most for its size: deviation over scale, its error
/// and what was predicted of it; the
/// number whose limit is farthest off for what it may be: distance over scale, and its error bar.
struct WorstNumber {
  double deviation = 0, deviation_error = 0, predicted = 0, miss = 0, miss_error = 0, bar = 0;
};
/// Of an impact that the discrete model has.
[[nodiscard]] WorstNumber worst_number(const Comparison& comparison, const ComparedImpact& impact);

/// One value of a swept scene.
struct SweptComparison {
  double value;
  Comparison comparison;
};
/// One row per value and impact: the worst number of each.
[[nodiscard]] Table swept_comparison_table(const Scene& scene, const std::vector<SweptComparison>& swept);
[[nodiscard]] Json swept_comparison_json(const Scene& scene, const std::vector<SweptComparison>& swept);
[[nodiscard]] Table swept_comparison_records(const Scene& scene, const std::vector<SweptComparison>& swept);

}  // namespace clatter::validation
