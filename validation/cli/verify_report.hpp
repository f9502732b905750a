// Results of checks as a table, as JSON.
#pragma once

#include <vector>

#include "validation/output/json.hpp"
#include "validation/output/table.hpp"
#include "validation/verify/verification.hpp"

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

[[nodiscard]] Table verify_table(const std::vector<CheckResult>& results, const std::string& selection, Format format);
[[nodiscard]] Json verify_json(const std::vector<CheckResult>& results, const std::string& selection);
/// All fields of each check, for CSV.
[[nodiscard]] Table verify_records(const std::vector<CheckResult>& results, const std::string& selection);

}  // namespace clatter::validation
