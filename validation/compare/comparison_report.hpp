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

}  // namespace clatter::validation
