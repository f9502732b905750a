// What `clatter plan` says.
#pragma once

#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/plan/plan.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> plan_columns();
/// A row for each model of the ladder.
[[nodiscard]] Report plan_report(const Scene& scene, const Plan& plan);

/// Why the plan does not give what was asked, one sentence; empty: it does.
[[nodiscard]] std::string plan_shortfall(const Plan& plan);

}  // namespace clatter::validation
