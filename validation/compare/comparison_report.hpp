// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter compare` says.
#pragma once

#include <vector>

#include "validation/compare/comparison.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> comparison_columns();
/// A row for each impact and number; tables leave out those that are zero by symmetry.
[[nodiscard]] Report comparison_report(const Scene& scene, const Comparison& comparison);

/// What a sweep's report shares with that of one comparison: the head without rows, and one comparison's fields and
/// rows, each behind the cells `front`.
/// @param approach  speed of the first contact in the discrete model [m/s]; none: it is swept
[[nodiscard]] Report begun_comparison(const Scene& scene, std::optional<double> approach);
void add_comparison(const Comparison& comparison, const Row& front, Value& fields, Grid& grid);
/// What the column of the mesh's corners is, and how far it is from the body's; empty: they are the same.
[[nodiscard]] std::string corners_words(const Comparison& comparison);
/// A difference, to two digits at most.
[[nodiscard]] Cell difference_cell(const Estimated& difference, double scale);
/// By how much the limit is off; 0 where the error bar, which stands beside it, leaves no digit.
[[nodiscard]] Cell miss_cell(const Estimated& miss);

// What `clatter compare` says of a swept scene.

/// The number of an impact that deviates most for its size: deviation over scale, its error and what was predicted of
/// it; the number whose limit is farthest off for what it may be: distance over scale, and its error bar.
struct WorstNumber {
  double deviation = 0, deviation_error = 0, predicted = 0, miss = 0, miss_error = 0, bar = 0;
};
/// The worst number of an impact that the discrete model has.
[[nodiscard]] WorstNumber worst_number(const Comparison& comparison, const ComparedImpact& impact);

/// One value of a swept scene.
struct SweptComparison {
  double value;
  Comparison comparison;
};
/// A row for each value, impact and number; in tables the worst number of each impact.
[[nodiscard]] Report swept_comparison_report(const Scene& scene, const std::vector<SweptComparison>& swept);

}  // namespace clatter::validation
