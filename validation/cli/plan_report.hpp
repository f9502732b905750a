// A plan as a table and as JSON.
#pragma once

#include "validation/output/json.hpp"
#include "validation/output/table.hpp"
#include "validation/plan/plan.hpp"

namespace clatter::validation {

[[nodiscard]] Table plan_table(const Scene& scene, const Plan& plan);
[[nodiscard]] Table plan_records(const Scene& scene, const Plan& plan);
[[nodiscard]] Json plan_json(const Scene& scene, const Plan& plan);

/// Why the plan does not give what was asked, one sentence; empty: it does.
[[nodiscard]] std::string plan_shortfall(const Plan& plan);

}  // namespace clatter::validation
