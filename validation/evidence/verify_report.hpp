// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter verify` says: its table, and the results as one HTML page that needs nothing beside it.
#pragma once

#include <string>
#include <vector>

#include "validation/evidence/check.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

/// Counts of a run.
struct VerifySummary {
  std::size_t passed = 0, failed = 0, not_run = 0;
  double seconds = 0;  ///< of all threads [s]
};
[[nodiscard]] VerifySummary summary_of(const std::vector<CheckResult>& results);
/// Exit status: 0 all passed, 1 a check failed, 130 interrupted.
[[nodiscard]] int verify_status(const VerifySummary& summary);
/// "75 of 75 checks passed; …".
[[nodiscard]] std::string summary_words(const VerifySummary& summary);

[[nodiscard]] std::vector<Column> verify_columns();
/// A row for each check.
[[nodiscard]] Report verify_report(const std::vector<CheckResult>& results, const std::string& selection);

/// The page: verdicts, and the figures that the checks belong to, redrawn from `case_runs` as inline SVG with the
/// command that reproduces each.  No script, no request to anywhere.
/// @throws std::runtime_error if gnuplot is not there or fails.
[[nodiscard]] std::string verify_page(const std::vector<CheckResult>& results, const std::string& selection,
                                      CaseRuns& case_runs);

}  // namespace clatter::validation
