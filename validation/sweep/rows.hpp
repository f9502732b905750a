// The rows of a sweep: CSV with numbers in their shortest round-trip form.
#pragma once

#include <string>

#include "analytic/sequence.hpp"
#include "numeric/simulate.hpp"
#include "validation/sweep/sweep_plan.hpp"

namespace clatter::validation {

/// Index and swept keys, then per scene
///     impacts, outcome, total_normal_impulse [N·s], first_peak_force, largest_peak_force [N] (continuous model),
///     energy_loss [J] and last_start [s] over the impacts listed;
/// or per impact what `clatter sequence` and `clatter simulate` write as CSV, and the scene's outcome.
[[nodiscard]] std::string column_names(const SweepPlan& plan);

/// What all rows of a scene begin with.
[[nodiscard]] std::string row_prefix(long long index, const std::vector<double>& values);

/// Appends the rows of one scene.  @param drop_deg its inclination [°]
void append_rows(std::string& out, const std::string& prefix, RowKind rows, const analytic::Sequence& sequence,
                 double drop_deg);
void append_rows(std::string& out, const std::string& prefix, RowKind rows, const numeric::Simulation& run);
/// The one row of a scene without numbers.
void append_failure(std::string& out, const std::string& prefix, const SweepPlan& plan, const char* outcome);

}  // namespace clatter::validation
