// SPDX-License-Identifier: GPL-3.0-or-later
// Runs checks in parallel and judges them.
#pragma once

#include <functional>
#include <vector>

#include "validation/verify/check.hpp"

namespace clatter::validation::inline verify {

struct CheckResult {
  const Check* check = nullptr;
  Measured measured;
  double seconds = 0;   ///< processor time of the thread [s]; work shared with other checks falls to the first
  std::string failure;  ///< why it failed; empty: passed
  bool done = false;    ///< false: an interrupt came first
  [[nodiscard]] bool passed() const { return done && failure.empty(); }
};

/// Runs `checks` with as many threads as the machine has; results in the order of the checks.
/// A check passes if its error is within the tolerance and the answer is the one that the table expects.
/// @param progress called with (done, of, id), from any thread but never at once; return false to end early.
[[nodiscard]] std::vector<CheckResult> verify_checks(
    const std::vector<const Check*>& checks, CaseRuns& case_runs,
    const std::function<bool(std::size_t, std::size_t, const std::string&)>& progress);

}  // namespace clatter::validation::inline verify
