// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/totals.hpp"

namespace clatter::validation {

Totals totals(const Run& run) {
  Totals sums;
  sums.impacts = static_cast<int>(run.impacts.size());
  for (const Impact& impact : run.impacts) {
    const Numbers &value = impact.value, &error = impact.error;
    const Estimated peak{value.peak_force, impact.predictable ? error.peak_force : unknown_error};
    const bool is_first = &impact == &run.impacts.front();
    sums.predictable = sums.predictable && impact.predictable;
    sums.normal_impulse += {value.impulse[2], error.impulse[2]};
    sums.energy_loss += {value.energy_loss, error.energy_loss};
    sums.last_start = {value.start, error.start};
    if (is_first) sums.first_peak = peak;
    sums.largest_peak = is_first ? peak : larger(sums.largest_peak, peak);
    const Estimated depth{value.indentation, error.indentation};
    sums.largest_depth = is_first ? depth : larger(sums.largest_depth, depth);
  }
  sums.normal_impulse += run.impulse_between;
  if (run.tail) sums.normal_impulse += {run.tail->sum.value.impulse[2], run.tail->sum.error.impulse[2]};
  if (run.total_normal_impulse) sums.normal_impulse = *run.total_normal_impulse;
  if (sums.predictable) return sums;
  for (Estimated* sum :
       {&sums.normal_impulse, &sums.energy_loss, &sums.last_start, &sums.largest_peak, &sums.largest_depth})
    sum->error = unknown_error;
  return sums;
}

void add_totals(const Totals& sums, Value& fields) {
  fields["total_normal_impulse"] = sums.normal_impulse.value;
  fields["total_normal_impulse_error"] = error_or_nothing(sums.normal_impulse);
  fields["predictable"] = sums.predictable;
}

std::string totals_line(const Totals& sums) {
  const auto text = [](const Value& number) { return number.is_nothing() ? "unknown" : number.text(); };
  return "total_normal_impulse: " + text(sums.normal_impulse.value) +
         "; total_normal_impulse_error: " + text(error_or_nothing(sums.normal_impulse));
}

}  // namespace clatter::validation
