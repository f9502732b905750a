// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter plan` says.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/plan/plan.hpp"
#include "validation/scene/argument.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> plan_columns();

/// What was asked of a plan, beside its scene.
struct PlanRequest {
  std::optional<double> within;               ///< [ms]
  std::function<bool(const char*)> is_given;  ///< whether the argument is ("digits")
};
[[nodiscard]] Argument within_argument(std::optional<double>& within);
/// @throws BadInput where an argument is given that the plan chooses or a sweep.
[[nodiscard]] PlanTarget plan_target(const Scene& scene, const PlanRequest& request);

/// A row for each model of the hierarchy.
[[nodiscard]] Report plan_report(const Scene& scene, const Plan& plan);

/// Error over cost of each model that was weighed, with what is asked.
[[nodiscard]] Picture plan_picture(const Scene& scene, const Plan& plan);

/// Why the plan does not give what was asked, one sentence; empty: it does.
[[nodiscard]] std::string plan_shortfall(const Plan& plan);

}  // namespace clatter::validation
