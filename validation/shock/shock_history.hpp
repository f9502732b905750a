// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter shock --rate` says.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation {

/// @param probes  the names of which columns are made: NAME_x, NAME_y, NAME_z
[[nodiscard]] std::vector<Column> shock_history_columns(const std::vector<std::string>& probes);
/// A row for each instant of uniform_history().  @pre run.continuous
[[nodiscard]] Grid shock_history_grid(const ShockRun& run, double rate);

/// Time after the first touch-down [s] and the size of each probe's specific force [g] at the samples of some pieces.
/// @pre run.continuous
[[nodiscard]] std::vector<std::vector<double>> felt_history(
    const ShockRun& run, const std::function<bool(const numeric::HistoryPiece&)>& wanted);

}  // namespace clatter::validation
