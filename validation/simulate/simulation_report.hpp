// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter simulate` says.
#pragma once

#include <vector>

#include "validation/output/report.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> simulation_columns();
/// A row for each impact.
[[nodiscard]] Report simulation_report(const Scene& scene, const PlannedRun& planned);

/// A sweep: the scene with its value and its run, one after the other.
struct SweptRun {
  double value;
  Scene scene;
  PlannedRun planned;
};
/// A row for each impact of each run, with the swept value in the first column; in tables the first impacts alone.
[[nodiscard]] Report sweep_report(const Scene& scene, const std::vector<SweptRun>& runs);

}  // namespace clatter::validation
