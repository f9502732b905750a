// What the reports of both models share.
#pragma once

#include <vector>

#include "validation/output/json.hpp"
#include "validation/output/table.hpp"

namespace clatter::validation {

/// Fewer digits, first in the columns from starts[0] on, then from starts[1] on, …, until the table fits 80
/// columns or only three digits are left.
void fit_columns(Table& table, int digits, const std::vector<std::size_t>& starts);

/// One row per object of the list with its names as columns, vectors spread over three (name_x, name_y, name_z), and
/// the numbers of "error_estimate" last, as name_error or name_x_error; other objects inside are left out.
void add_impact_records(Table& table, const Json& impacts);

/// The sum of the normal impulses of a run's JSON and its error, as a note of the CSV.
[[nodiscard]] std::string total_note(const Json& run);

/// A number, text or nothing.
[[nodiscard]] Cell json_cell(const Json& value);

}  // namespace clatter::validation
