#include "validation/cli/simulation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/cli/impact_records.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/swept_column.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/impact_entries.hpp"
#include "validation/output/names.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using numeric::ImpactNumbers;
using numeric::ImpactRecord;
using numeric::Outcome;
using numeric::Simulation;
using numeric::Vector3;

constexpr double degrees = 180 / std::numbers::pi;

double ratio_error(const ImpactRecord& row) {
  return (row.error.impulse.norm() * (1 + std::fabs(impulse_ratio(row.value)))) / std::fabs(row.value.impulse.z());
}

Json impact_json(const ImpactRecord& row, int n) {
  Json json, errors;
  for_each_entry(row, n, [&](const char* name, const auto& value) { json[name] = entry_json(value); });
  for_each_number(row.error, [&](const char* name, const auto& value) { errors[name] = entry_json(value); });
  errors["impulse_ratio"] = number_or_null(ratio_error(row));
  json["error_estimate"] = errors;
  return json;
}

/// Whether rounding or the method's error has outgrown the row by itself; what follows such a row is no better.
bool doubtful(const SimulationScene& scene, const ImpactRecord& row) {
  const double gap_of_method = std::max(1e-6, std::pow(10.0, -scene.options.digits));
  if (!row.predictable || !(std::fabs(row.ledger_gap) <= gap_of_method)) return true;
  if (!scene.options.error_estimates) return false;
  return !(row.error.impulse.norm() <= 0.05 * row.value.impulse.norm());
}

/// What is known of a number: the digits that its estimated error leaves, 0 if none; two digits in a row that is not to
/// be trusted.
Cell known(const SimulationScene& scene, double value, double error, bool trusted = true) {
  if (!scene.options.error_estimates) return {value, scene.options.digits};
  if (!trusted || !std::isfinite(error)) return {value, 2};
  if (std::fabs(value) <= error) return {0.0, 1};
  return {value, std::min(scene.options.digits, known_digits(value, error))};
}

std::string method_words(const Simulation& run) {
  const std::string how = run.tolerance > 0 ? fmt::format("tolerance {} per step", significant(run.tolerance, 2))
                                            : fmt::format("steps of {} s", significant(run.step, 4));
  return fmt::format("{}, {}; {} force evaluations, with those for plan and error estimates", method_name(run.method), how,
                     run.force_evaluations);
}

/// The number of impacts before the first doubtful one.
std::size_t trusted(const SimulationScene& scene, const Simulation& run) {
  const auto first = std::find_if(run.impacts.begin(), run.impacts.end(),
                                  [&](const ImpactRecord& row) { return doubtful(scene, row); });
  return static_cast<std::size_t>(first - run.impacts.begin());
}

std::string trust_words(const SimulationScene& scene, const Simulation& run) {
  const std::size_t last_trusted = trusted(scene, run);
  if (last_trusted == run.impacts.size()) return "";
  const auto first = run.impacts.begin() + static_cast<std::ptrdiff_t>(last_trusted);
  const std::string growth = first->predictable
                                 ? "after it a second run goes another way"
                                 : fmt::format("an error of the start has grown {} times by then",
                                               significant(first->amplification, 2));
  return last_trusted == 0 ? fmt::format("?: not to be trusted: {}", growth)
                           : fmt::format("?: trust ends with impact {}: {}", last_trusted, growth);
}

/// What was asked against what came out, by the estimates.
std::string accuracy_words(const SimulationScene& scene, const PlannedRun& planned) {
  if (std::isnan(planned.achieved)) return "";
  const int known = planned.known_impacts, impacts = static_cast<int>(planned.run.impacts.size());
  const std::string of = known < impacts ? fmt::format(" of the first {} impacts", known) : "";
  if (!std::isfinite(planned.achieved)) {
    return fmt::format("asked {} digits{}: a second run goes another way", scene.options.digits, of);
  }
  return fmt::format("asked {} digits, achieved {:.1f}{}: largest estimated error {} of the sequence's sizes",
                     scene.options.digits, std::max(-std::log10(planned.achieved), 0.0), of,
                     significant(planned.achieved, 1));
}

std::vector<std::string> notes_of(const SimulationScene& scene, const PlannedRun& planned) {
  const Simulation& run = planned.run;
  std::vector<std::string> notes;
  const std::string trust = trust_words(scene, run);
  if (!trust.empty()) notes.push_back(trust);
  for (const std::string& warning : planned.warnings) notes.push_back("!: warning: " + warning);
  double gap = 0;
  for (const ImpactRecord& row : run.impacts) gap = std::max(gap, std::fabs(row.ledger_gap));
  if (!run.impacts.empty()) {
    notes.push_back(fmt::format("Sum of normal impulses: {} N·s; the ledger of energy closes to {}",
                                significant(run.total_normal_impulse(), scene.options.digits), significant(gap, 1)));
  }
  notes.push_back(method_words(run));
  const std::string accuracy = accuracy_words(scene, planned);
  if (!accuracy.empty()) notes.push_back(accuracy);
  notes.push_back(fmt::format("{}: {}", outcome_name(run.outcome), run.message));
  return notes;
}

std::vector<std::string> head_of(const SimulationScene& scene, const std::string& what) {
  std::vector<std::string> head{headline("simulate", what)};
  for (const std::string& line : scene.summary()) head.push_back(line);
  return head;
}

const char* const what_it_is = "impact sequence, continuous contact";

Cell loss_cell(const SimulationScene& scene, const Simulation& run, const ImpactRecord& row, bool trusted = true) {
  const double percent = 100 / run.energy_start;
  // Below the method's error the loss is none.
  if (std::fabs(row.value.energy_loss) <= 1e-9 * run.energy_start) return {0.0, 1};
  return known(scene, row.value.energy_loss * percent, row.error.energy_loss * percent, trusted);
}

Json quantity_json(const SimulationScene& scene, const SweptRun& swept) {
  Json json{{scene.sweep->name(), swept.value},
            {"outcome", outcome_name(swept.run.outcome)},
            {"message", swept.run.message}};
  json["impacts"] = Json::array();
  int n = 0;
  for (const ImpactRecord& row : swept.run.impacts) json["impacts"].push_back(impact_json(row, ++n));
  return json;
}

}  // namespace

Table simulation_table(const SimulationScene& scene, const PlannedRun& planned) {
  const Simulation& run = planned.run;
  const bool friction = scene.ground.has_friction();
  const bool loses = friction || scene.ground.damping > 0;
  Table table{.head = head_of(scene, what_it_is), .columns = {}, .rows = {}, .notes = notes_of(scene, planned)};
  table.columns = {{"n", "n", ""}, {"end", "end", ""}, {"start", "t", "s"}, {"duration", "contact", "s", !friction},
                   {"contact_angle_deg", "angle", "°"}, {"impulse_normal", "Pₙ", "N·s"},
                   {"impulse_tangential", "Pₜ", "N·s", friction}, {"peak_force", "peak Fₙ", "N"},
                   {"velocity_after_z", "Vₙ", "m/s"}, {"angular_velocity_after_y", "Ω", "rad/s"},
                   {"energy_loss", "loss", "%", loses}};
  const std::size_t trust = trusted(scene, run);
  std::size_t n = 0;
  for (const ImpactRecord& row : run.impacts) {
    const ImpactNumbers &v = row.value, &e = row.error;
    const bool trusted_row = ++n <= trust;
    const auto cell = [&](double value, double error) { return known(scene, value, error, trusted_row); };
    table.rows.push_back({Cell(std::to_string(n) + (trusted_row ? "" : "?") + (row.submerged ? "!" : "")), Cell(end_name(row.end)),
                          cell(v.start, e.start), cell(v.duration, e.duration),
                          cell(v.contact_angle * degrees, e.contact_angle * degrees),
                          cell(v.impulse.z(), e.impulse.z()), cell(v.impulse.x(), e.impulse.x()),
                          cell(v.peak_force, e.peak_force), cell(v.velocity_after.z(), e.velocity_after.z()),
                          cell(v.angular_velocity_after.y(), e.angular_velocity_after.y()),
                          loss_cell(scene, run, row, trusted_row)});
  }
  fit_columns(table, scene.options.digits, {2});
  return table;
}

Json simulation_json(const SimulationScene& scene, const PlannedRun& planned) {
  const Simulation& run = planned.run;
  Json json{{"clatter", version}, {"model", "continuous"}, {"scene", scene.json()}, {"impacts", Json::array()}};
  int n = 0;
  for (const ImpactRecord& row : run.impacts) json["impacts"].push_back(impact_json(row, ++n));
  json["outcome"] = outcome_name(run.outcome);
  json["warnings"] = planned.warnings;
  json["message"] = run.message + "; restitution is null where an impact has several touches";
  json["method"] = method_name(run.method);
  json["tolerance"] = run.tolerance > 0 ? Json(run.tolerance) : Json(nullptr);
  json["step"] = run.step > 0 ? Json(run.step) : Json(nullptr);
  json["accuracy"] = {{"asked", planned.asked}, {"achieved", number_or_null(planned.achieved)},
                      {"known_impacts", planned.known_impacts}, {"planned", planned.planned}};
  json["total_normal_impulse"] = number_or_null(run.total_normal_impulse());
  json["energy_start"] = number_or_null(run.energy_start);
  json["cost"] = {{"force_evaluations", run.force_evaluations}, {"root_evaluations", run.root_evaluations}};
  return json;
}

Table simulation_records(const SimulationScene& scene, const PlannedRun& planned) {
  const Json json = simulation_json(scene, planned);
  Table table{.head = {headline("simulate", what_it_is), "scene: " + json["scene"].dump()}, .columns = {}, .rows = {},
              .notes = notes_of(scene, planned)};
  add_impact_records(table, json["impacts"]);
  return table;
}

Table sweep_table(const SimulationScene& scene, const std::vector<SweptRun>& runs) {
  Table table{.head = head_of(scene, "first impacts, continuous contact"), .columns = {}, .rows = {}, .notes = {}};
  table.columns = {swept_column(*scene.sweep),
                   {"touches", "touches", ""}, {"impulse_normal", "Pₙ", "N·s"}, {"impulse_ratio", "Pₜ/Pₙ", ""},
                   {"velocity_after_x", "Vₜ", "m/s"}, {"velocity_after_z", "Vₙ", "m/s"},
                   {"angular_velocity_after_y", "Ω", "rad/s"}, {"peak_force", "peak Fₙ", "N"},
                   {"energy_loss", "loss", "%"}};
  for (const SweptRun& swept : runs) {
    auto& row = table.rows.emplace_back();
    row.emplace_back(swept.value, 6);
    if (swept.run.impacts.empty()) {
      row.emplace_back(std::string(outcome_name(swept.run.outcome)));
      row.resize(table.columns.size());
      continue;
    }
    const ImpactRecord& first = swept.run.impacts[0];
    const ImpactNumbers &v = first.value, &e = first.error;
    row.emplace_back(std::to_string(first.touches));
    row.push_back(known(scene, v.impulse.z(), e.impulse.z()));
    row.push_back(known(scene, impulse_ratio(v), ratio_error(first)));
    row.push_back(known(scene, v.velocity_after.x(), e.velocity_after.x()));
    row.push_back(known(scene, v.velocity_after.z(), e.velocity_after.z()));
    row.push_back(known(scene, v.angular_velocity_after.y(), e.angular_velocity_after.y()));
    row.push_back(known(scene, v.peak_force, e.peak_force));
    row.push_back(loss_cell(scene, swept.run, first));
  }
  if (!runs.empty()) table.notes.push_back(method_words(runs.back().run) + " (the last row's)");
  add_interruption(*scene.sweep, runs.size(), table);
  fit_columns(table, scene.options.digits, {2});
  return table;
}

Json sweep_json(const SimulationScene& scene, const std::vector<SweptRun>& runs) {
  Json json{{"clatter", version}, {"model", "continuous"}, {"scene", scene.json()}, {"runs", Json::array()}};
  for (const SweptRun& swept : runs) json["runs"].push_back(quantity_json(scene, swept));
  const std::size_t values = scene.sweep->values().size();
  json["outcome"] = runs.size() < values ? "interrupted" : "complete";
  json["message"] = fmt::format("{} of {} values", runs.size(), values);
  return json;
}

Table sweep_records(const SimulationScene& scene, const std::vector<SweptRun>& runs) {
  Table table{.head = {headline("simulate", "impacts over a sweep, continuous contact"),
                       "scene: " + scene.json().dump()},
              .columns = {}, .rows = {}, .notes = {}};
  for (const SweptRun& swept : runs) {
    const std::size_t before = table.rows.size();
    add_impact_records(table, quantity_json(scene, swept)["impacts"]);
    for (std::size_t i = before; i < table.rows.size(); ++i) {
      table.rows[i].insert(table.rows[i].begin(), Cell(swept.value, 17));
    }
    if (swept.run.impacts.empty()) {
      table.notes.push_back(fmt::format("{}: {}: {}", shortest(swept.value), outcome_name(swept.run.outcome),
                                        swept.run.message));
    }
  }
  add_interruption(*scene.sweep, runs.size(), table);
  table.columns.insert(table.columns.begin(), swept_record_column(*scene.sweep));
  return table;
}

}  // namespace clatter::validation
