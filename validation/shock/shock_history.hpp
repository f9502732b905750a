// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter shock --rate` says.
#pragma once

#include <vector>

#include "validation/output/report.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation {

/// @param probes  the names of which columns are made: NAME_x, NAME_y, NAME_z
[[nodiscard]] std::vector<Column> shock_history_columns(const std::vector<std::string>& probes);
/// A row for each instant of uniform_history().  @pre run.continuous
[[nodiscard]] Grid shock_history_grid(const ShockRun& run, double rate);

}  // namespace clatter::validation
