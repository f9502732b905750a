// SPDX-License-Identifier: GPL-3.0-or-later
// A grid as a table of aligned columns.
#pragma once

#include <cstddef>
#include <string>

#include "validation/output/report.hpp"

namespace clatter::validation::inline output {

inline constexpr std::size_t table_width = 80;  ///< of a terminal

/// Width of the table if nothing is folded.
[[nodiscard]] std::size_t natural_width(const Grid& grid);

/// Heading, unit, a rule, and a line for each row.  Where that is wider than `table_width`, texts are folded at blanks;
/// if columns still do not fit beside each other, the rest of them follow in further blocks, each of which begins with
/// the grid's leading columns again.
[[nodiscard]] std::string aligned_grid(const Grid& grid);

}  // namespace clatter::validation::inline output
