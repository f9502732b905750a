// SPDX-License-Identifier: GPL-3.0-or-later
// The body at the times that a scene asks for, of either model.
#pragma once

#include <string>
#include <vector>

#include "validation/output/estimated.hpp"
#include "validation/output/report.hpp"
#include "validation/run/run.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// run.at and the grid of run.rate, which ends at run.until or, without it, with the last of what the run tells,
/// ascending, each once.
/// @throws BadInput where there are more than a million
[[nodiscard]] std::vector<double> state_times(const Scene& scene, const Run& run);

/// What tables, CSV and JSON have of a state.
[[nodiscard]] std::vector<Column> state_columns();
/// Sizes against which numbers count as zero [m, m/s, rad/s, J].
struct StateSizes {
  double length = 0, speed = 0, rate = 0, energy = 0;
};
/// The states of a run in rows, with the errors of their numbers.
/// @param in_plane  tables leave out the motion out of the plane
[[nodiscard]] Grid state_grid(const Run& run, bool in_plane, int digits, const StateSizes& sizes);
/// Which states lie so near to an impact that errors decide on which side, and which are not known; empty: none.
[[nodiscard]] std::vector<std::string> state_notes(const Run& run);

/// --rows states: a report with the rows of its second table alone.
[[nodiscard]] Report with_states_alone(Report report);
/// @throws BadInput for --rows states of a scene that asks for none
void require_states(bool asked, const Scene& scene);

}  // namespace clatter::validation
