// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/simulate/simulation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/impact_rows.hpp"
#include "validation/run/rest_face.hpp"
#include "validation/run/run.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/run/states.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/facet_words.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

using numeric::ImpactRecord;
using numeric::Simulation;

/// Whether the ledger of energy stays open by more than the errors of its entries: the dampers' and friction's work are
/// integrals that no step is chosen for, and lose up to two digits of those asked.
bool is_ledger_open(const Scene& scene, const Simulation& run, const ImpactRecord& row) {
  const double entries =
      row.error.energy_loss + row.error.work_damping + row.error.work_friction + row.error.work_released;
  const double of_method = std::max(1e-6, std::pow(10.0, -scene.accuracy.digits));
  const double limit = scene.request.error_estimates
                           ? of_method + 2 * entries / std::max(run.energy_start, row.energy_stored)
                           : 100 * of_method;
  return !(std::fabs(row.ledger_gap) <= limit);
}

/// Why the numbers of an impact are not known, one clause; empty: they are.  What follows such an impact is no better.
std::string doubt(const Scene& scene, const Simulation& run, const ImpactRecord& row) {
  if (!row.predictable) {
    return numeric::is_predictable(row.amplification)
               ? "a second, finer run has other contacts, or does not get as far"
               : fmt::format("an error of the start has grown {} times by then", significant(row.amplification, 2));
  }
  if (is_ledger_open(scene, run, row))
    return fmt::format("the ledger of energy stays open by {}", significant(std::fabs(row.ledger_gap), 1));
  const bool is_known = !scene.request.error_estimates || row.error.impulse.norm() <= 0.05 * row.value.impulse.norm();
  return is_known ? "" : "after it a second run goes another way";
}

/// The number of impacts before the first doubtful one.
std::size_t trusted_impacts(const Scene& scene, const Simulation& run) {
  const auto first = std::find_if(run.impacts.begin(), run.impacts.end(),
                                  [&](const ImpactRecord& row) { return !doubt(scene, run, row).empty(); });
  return static_cast<std::size_t>(first - run.impacts.begin());
}

/// What tables show of the numbers of a run; `trusted`: of an impact that is to be trusted.
ImpactDigits digits_of(const Scene& scene, const PlannedRun& planned, bool trusted) {
  const MotionNumbers& sizes = planned.sizes;
  return {.digits = scene.accuracy.digits,
          .trusted = trusted,
          .estimated = scene.request.error_estimates,
          .scales = {0, sizes[0], sizes[1], sizes[4], sizes[7], sizes[9], planned.run.energy_start, 1}};
}

/// The sum of the normal impulses as far as it is known.
std::string total_words(const Scene& scene, const PlannedRun& planned, const Run& run) {
  const Estimated total = totals(run).normal_impulse;
  const bool trusted = trusted_impacts(scene, planned.run) == planned.run.impacts.size();
  ImpactDigits digits = digits_of(scene, planned, trusted);
  return shown_text(digits.cell(total.value, total.error, Scale::none));
}

std::string method_words(const Simulation& run) {
  const std::string how = run.tolerance > 0 ? fmt::format("tolerance {} per step", significant(run.tolerance, 2))
                                            : fmt::format("steps of {} s", significant(run.step, 4));
  return fmt::format("{}, {}; {} force evaluations, with those for plan and error estimates", method_name(run.method),
                     how, run.force_evaluations);
}

std::string trust_words(const Scene& scene, const Simulation& run) {
  const std::size_t last_trusted = trusted_impacts(scene, run);
  if (last_trusted == run.impacts.size()) return "";
  const std::string why = doubt(scene, run, run.impacts[last_trusted]);
  return last_trusted == 0 ? fmt::format("?: not to be trusted: {}", why)
                           : fmt::format("?: trust ends with impact {}: {}", last_trusted, why);
}

/// What was asked against what came out, by the estimates.
std::string accuracy_words(const Scene& scene, const PlannedRun& planned) {
  if (std::isnan(planned.achieved)) return "";
  const int known = planned.known_impacts, impacts = static_cast<int>(planned.run.impacts.size());
  const std::string of = known < impacts ? fmt::format(" of the first {} impacts", known) : "";
  if (!std::isfinite(planned.achieved))
    return fmt::format("asked {} digits{}: a second run goes another way", scene.accuracy.digits, of);
  return fmt::format("asked {} digits, achieved {:.1f}{}: largest estimated error {} of the sequence's sizes",
                     scene.accuracy.digits, std::max(-std::log10(planned.achieved), 0.0), of,
                     significant(planned.achieved, 1));
}

/// What the scene's law of friction leaves out, if that exceeds the digits asked.
std::string local_slip_words(const Scene& scene, const Simulation& run) {
  double largest = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < run.impacts.size(); ++i) {
    largest = std::max(largest, run.impacts[i].value.impulse.norm());
    if (run.impacts[i].local_slip > run.impacts[worst].local_slip) worst = i;
  }
  if (run.impacts.empty() || !(run.impacts[worst].local_slip > std::pow(10.0, -scene.accuracy.digits) * largest))
    return "";
  return fmt::format(
      "coulomb takes the patch as flat: with each place's own slip (friction_law = \"local\") the tangential "
      "impulse of impact {} would change by about {} N·s, and what follows with it",
      worst + 1, significant(run.impacts[worst].local_slip, 1));
}

/// How deep the body goes at most.
std::string depth_words(const Scene& scene, const PlannedRun& planned, const Run& run) {
  const auto deepest = std::ranges::max_element(run.impacts, {}, [](const Impact& i) { return i.value.indentation; });
  const Estimated depth = totals(run).largest_depth;
  return fmt::format(
      "Greatest indentation: {} m, in impact {}",
      shown_text(digits_of(scene, planned, deepest->predictable).cell(depth.value, depth.error, Scale::none)),
      deepest->n);
}

/// What the results leave out; none is empty.
std::vector<std::string> remarks_of(const Scene& scene, const Simulation& run) {
  std::vector<std::string> remarks{other_law_remark(scene, run), local_slip_words(scene, run)};
  std::erase(remarks, "");
  return remarks;
}

/// @param record  of the run, as of the functions below
std::vector<std::string> notes_of(const Scene& scene, const PlannedRun& planned, const Run& record) {
  const Simulation& run = planned.run;
  std::vector<std::string> notes{planned.first_touch ? words_of(*planned.first_touch) : "", trust_words(scene, run)};
  for (const std::string& warning : planned.warnings) notes.push_back("!: warning: " + warning);
  double gap = 0;
  for (const ImpactRecord& row : run.impacts) gap = std::max(gap, std::fabs(row.ledger_gap));
  if (!run.impacts.empty()) {
    notes.push_back(fmt::format("Sum of normal impulses: {} N·s; the ledger of energy closes to {}",
                                total_words(scene, planned, record), significant(gap, 1)));
    notes.push_back(depth_words(scene, planned, record));
  }
  for (const std::string& remark : remarks_of(scene, run)) notes.push_back(remark);
  for (const std::string& words : state_notes(record)) notes.push_back(words);
  for (const std::string& words :
       {method_words(run), accuracy_words(scene, planned), fmt::format("{}: {}", outcome_name(run), run.message)}) {
    notes.push_back(words);
  }
  std::erase(notes, "");
  return notes;
}

bool has_friction(const Scene& scene) {
  const bool swept = scene.sweep && scene.sweep->quantity == SceneSweep::Quantity::friction;
  return swept || scene.world.ground.has_friction();
}

/// Whether a table names the corners that touch instead of the ends of the body.
bool names_corners(const Scene& scene) {
  return scene.body.shape == BodyScene::Shape::box && !reason_in_space(scene).empty();
}

std::vector<Column> columns_of(const Scene& scene) {
  const bool friction = has_friction(scene);
  std::vector<std::string> shown{"n",
                                 names_corners(scene) ? "corners" : "end",
                                 "start",
                                 "duration",
                                 "contact_angle_deg",
                                 "impulse_normal",
                                 "peak_force",
                                 "velocity_after_z",
                                 "angular_velocity_after_y"};
  if (friction) shown.emplace_back("impulse_tangential");
  if (friction || scene.world.ground.is_damped()) shown.emplace_back("energy_loss");
  return impact_columns(RunModel::continuous, shown);
}

std::vector<Row> rows_of(const Scene& scene, const PlannedRun& planned, const Run& record) {
  std::vector<Row> rows;
  const std::size_t trust = trusted_impacts(scene, planned.run);
  for (const Impact& impact : record.impacts) {
    const bool trusted = rows.size() < trust;
    rows.push_back(impact_row(impact, RunModel::continuous, digits_of(scene, planned, trusted)));
    rows.back()[0].shown = fmt::format("{}{}{}", impact.n, trusted ? "" : "?", impact.submerged ? "!" : "");
  }
  return rows;
}

/// Beside friction the table has room for three digits of how long contacts take.
void shorten_durations(const Scene& scene, Grid& table) {
  if (!has_friction(scene)) return;
  const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                   [](const Column& one) { return one.name == "duration"; });
  const auto place = static_cast<std::size_t>(column - table.columns.begin());
  for (Row& row : table.rows) {
    if (place < row.size()) row[place].digits = std::min(row[place].digits, 3);
  }
}

Value shortfall_value(const Scene& scene, const PlannedRun& planned) {
  return text_or_nothing(shortfall(scene, planned));
}

void add_results(const Scene& scene, const PlannedRun& planned, const Run& record, Value& fields) {
  const Simulation& run = planned.run;
  fields["outcome"] = outcome_name(run);
  fields["warnings"] = planned.warnings;
  if (const std::string facets = facet_words(scene, run); !facets.empty()) fields["warnings"].push_back(facets);
  fields["message"] = run.message + "; restitution is null where an impact has several touches";
  fields["notes"] = remarks_of(scene, run);
  fields["method"] = method_name(run.method);
  fields["tolerance"] = run.tolerance > 0 ? Value(run.tolerance) : Value();
  fields["step"] = run.step > 0 ? Value(run.step) : Value();
  fields["accuracy"] = Value::Fields{{"asked", planned.asked},
                                     {"achieved", planned.achieved},
                                     {"known_impacts", planned.known_impacts},
                                     {"planned", planned.planned}};
  add_totals(totals(record), fields);
  fields["shortfall"] = shortfall_value(scene, planned);
  fields["energy_start"] = run.energy_start;
  if (planned.first_touch) fields["first_touch"] = fields_of(*planned.first_touch);
  if (const auto rest = rest_face(scene, run)) fields["rest"] = fields_of(*rest);
  if (record.end_motion) fields["end_motion"] = fields_of(*record.end_motion);
  fields["cost"] =
      Value::Fields{{"force_evaluations", run.force_evaluations}, {"root_evaluations", run.root_evaluations}};
}

/// Adds the impacts of a run to the report of a sweep.
void add_run(const SweptRun& swept, const Scene& scene, Report& report) {
  const Simulation& run = swept.planned.run;
  Grid impacts{impact_columns(RunModel::continuous, {}),
               rows_of(swept.scene, swept.planned, named_run(swept.scene, run))};
  report.fields["runs"].push_back(Value::Fields{{scene.sweep->name(), swept.value},
                                                {"outcome", outcome_name(run)},
                                                {"message", run.message},
                                                {"shortfall", shortfall_value(swept.scene, swept.planned)},
                                                {"impacts", row_objects(impacts)}});
  for (Row& row : impacts.rows) {
    const bool is_first = &row == &impacts.rows.front();
    row.insert(row.begin(), Cell(swept.value, 6));
    report.grid.rows.push_back(row);
    if (!is_first) row.front() = Cell();  // readers see the value once
    report.digest->rows.push_back(std::move(row));
  }
  if (run.impacts.empty()) report.digest->rows.push_back({Cell(swept.value, 6), Cell("–"), Cell(outcome_name(run))});
  if (run.impacts.empty() || is_cut_short(run.outcome))
    report.remarks.push_back(fmt::format("{}: {}: {}", shortest(swept.value), outcome_name(run), run.message));
}

}  // namespace

std::vector<Column> simulation_columns() { return impact_columns(RunModel::continuous, {}); }

Report simulation_report(const Scene& scene, const PlannedRun& planned) {
  Report report = scene_report("simulate", "impact sequence, continuous contact", "continuous", scene);
  if (const std::string facets = facet_words(scene, planned.run); !facets.empty()) report.head.push_back(facets);
  const Run record = named_run(scene, planned.run);
  report.notes = notes_of(scene, planned, record);
  report.remarks = {totals_line(totals(record))};
  report.grid = {columns_of(scene), rows_of(scene, planned, record)};
  report.fields["impacts"] = row_objects(report.grid);
  if (scene.has_times()) {
    const bool is_still = planned.run.impacts.empty();  // nothing says then how fast it might be
    const double speed = is_still ? 1 : planned.sizes[5], rate = is_still ? 1 : planned.sizes[8];
    report.further = state_grid(
        record, reason_in_space(scene).empty(), scene.accuracy.digits,
        {.length = rate > 0 ? speed / rate : 0, .speed = speed, .rate = rate, .energy = planned.run.energy_start});
    report.fields["states"] = row_objects(*report.further);
  }
  add_results(scene, planned, record, report.fields);
  shorten_durations(scene, report.grid);
  return report;
}

Report sweep_report(const Scene& scene, const std::vector<SweptRun>& runs) {
  Report report = scene_report("simulate", "impact sequences, continuous contact", "continuous", scene);
  report.grid.columns = columns_of(scene);
  report.grid.columns.insert(report.grid.columns.begin(), swept_column(*scene.sweep));
  report.digest = Grid{report.grid.columns, {}, 2};
  report.fields["runs"] = Value::List{};
  for (const SweptRun& swept : runs) add_run(swept, scene, report);
  const std::size_t values = scene.sweep->values().size();
  report.fields["outcome"] = runs.size() < values ? "interrupted" : "complete";
  report.fields["message"] = fmt::format("{} of {} values", runs.size(), values);
  if (!runs.empty()) report.notes.push_back(method_words(runs.back().planned.run) + " (the last row's)");
  add_interruption(*scene.sweep, runs.size(), report);
  shorten_durations(scene, *report.digest);
  return report;
}

}  // namespace clatter::validation
