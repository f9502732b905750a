// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/record/totals.hpp"

namespace clatter::validation::inline record {
namespace {

void forget(Totals& sums) {
  for (Estimated* sum : {&sums.normal_impulse, &sums.energy_loss, &sums.last_start, &sums.largest_peak})
    sum->error = unknown_error;
}

}  // namespace

Totals totals(const analytic::Sequence& sequence) {
  Totals sums;
  sums.impacts = static_cast<int>(sequence.rows.size());
  for (const analytic::ImpactRow& row : sequence.rows) {
    sums.predictable = sums.predictable && row.error.predictable;
    sums.energy_loss += {row.impact.energy_loss, row.error.energy_loss};
    sums.last_start = {row.start, row.error.start};
  }
  sums.normal_impulse = {sequence.total_normal_impulse, sequence.total_normal_impulse_error};
  return sums;
}

Totals totals(const analytic::space::Sequence& sequence) {
  Totals sums;
  sums.impacts = static_cast<int>(sequence.rows.size());
  for (const analytic::space::ImpactRow& row : sequence.rows) {
    sums.predictable = sums.predictable && row.error.predictable;
    sums.normal_impulse += {row.impact.impulse.z(), row.error.impulse};
    sums.energy_loss += {row.impact.energy_loss, row.error.energy_before + row.error.energy_after};
    sums.last_start = {row.start, row.error.start};
  }
  if (sequence.tail) sums.normal_impulse += {sequence.tail->normal_impulse, sequence.tail->normal_impulse_error};
  if (!sums.predictable) forget(sums);
  return sums;
}

Totals totals(const numeric::Simulation& run) {
  Totals sums;
  sums.impacts = static_cast<int>(run.impacts.size());
  for (const numeric::ImpactRecord& row : run.impacts) {
    const numeric::ImpactNumbers &value = row.value, &error = row.error;
    const Estimated peak{value.peak_force, row.predictable ? error.peak_force : unknown_error};
    const bool is_first = &row == &run.impacts.front();
    sums.predictable = sums.predictable && row.predictable;
    sums.normal_impulse += {value.impulse.z(), error.impulse.z()};
    sums.energy_loss += {value.energy_loss, error.energy_loss};
    sums.last_start = {value.start, error.start};
    if (is_first) sums.first_peak = peak;
    sums.largest_peak = is_first ? peak : larger(sums.largest_peak, peak);
  }
  if (!sums.predictable) forget(sums);
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

}  // namespace clatter::validation::inline record
