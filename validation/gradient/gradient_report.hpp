// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter gradient` says: derivatives of the state after each impact with respect to the drop.
#pragma once

#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> gradient_columns(bool in_space);

/// A report, and why it lacks impacts or derivatives that were asked for.
struct GradientReport {
  Report report;
  std::string shortfall;  ///< in one line; empty: it lacks none
  int status = 0;         ///< exit status
};

/// A row for each impact and each number of the drop.  Of a drop from a height or clearance that takes the speed's
/// place, and the derivatives of turns are those at a fixed height.
/// @throws as analytic::sequence_gradient
[[nodiscard]] GradientReport gradient_report(const PreparedScene& prepared);

}  // namespace clatter::validation
