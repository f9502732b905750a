// SPDX-License-Identifier: GPL-3.0-or-later
// The map of what holds: every model over every quantity up to its ends.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/evidence/cell.hpp"
#include "validation/evidence/extreme_cases.hpp"

namespace clatter::validation {

/// Neighbouring values of one quantity for which one model does the same, with digits within one of each other.
struct MapRegion {
  std::size_t first = 0, last = 0;  ///< cells
  double fewest_digits = 0, most_digits = 0;
  double slowest = 0;  ///< cost of the model in the slowest cell [s]
};

struct ExtremesMap {
  std::vector<ExtremeCell> cells{};  ///< axis by axis, model by model, in the order of the values
  std::vector<MapRegion> regions{};
  double cell_seconds = 1;  ///< that a cell may take
  std::uint64_t seed = 1;
  bool complete = true;  ///< false: interrupted
};

struct ExtremesOptions {
  std::vector<std::string> axes;  ///< names; empty: all
  bool long_runs = true;
  LongRuns runs = {};
  double cell_seconds = 1;
  /// Called with (done, of); return false to end early with the cells so far.
  std::function<bool(std::size_t, std::size_t)> progress = nullptr;
};

[[nodiscard]] ExtremesMap measure_extremes(const ExtremesOptions& options);

/// The regions of the cells in their order.
[[nodiscard]] std::vector<MapRegion> regions_of(const std::vector<ExtremeCell>& cells);

/// "angle = F2, discrete: error 1, at most 1e-13 allowed" for each cell that breaks a promise.
[[nodiscard]] std::vector<std::string> map_failures(const ExtremesMap& map);

/// 0; 1 if a cell breaks a promise; 130 if the map is not complete.
[[nodiscard]] int map_status(const ExtremesMap& map);

/// The cell that took longest, long runs left out; null if there is none.
[[nodiscard]] const ExtremeCell* slowest_cell(const ExtremesMap& map);

}  // namespace clatter::validation
