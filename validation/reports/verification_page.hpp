// SPDX-License-Identifier: GPL-3.0-or-later
// The results as one HTML page that needs nothing beside it.
#pragma once

#include <string>
#include <vector>

#include "validation/verify/check.hpp"

namespace clatter::validation::inline reports {

/// Verdicts, and the figures that the checks belong to, redrawn from `case_runs` as inline SVG with the command that
/// reproduces each.  No script, no request to anywhere.
/// @throws std::runtime_error if gnuplot is not there or fails.
[[nodiscard]] std::string verify_page(const std::vector<CheckResult>& results, const std::string& selection,
                                      CaseRuns& case_runs);

}  // namespace clatter::validation::inline reports
