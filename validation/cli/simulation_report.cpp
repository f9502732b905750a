#include "validation/cli/simulation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "validation/cli/impact_records.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/swept_column.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/impact_entries.hpp"
#include "validation/output/names.hpp"
#include "validation/output/number.hpp"
#include "validation/output/totals.hpp"
#include "validation/plan/shortfall.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

using numeric::ImpactNumbers;
using numeric::ImpactRecord;
using numeric::Outcome;
using numeric::Simulation;
using numeric::Vector3;

constexpr double degrees = 180 / std::numbers::pi;

Json impact_json(const ImpactRecord& row, int n) {
  Json json, errors;
  for_each_entry(row, n, [&](const char* name, const auto& value) { json[name] = entry_json(value); });
  for_each_error(row, [&](const char* name, const auto& error) { errors[name] = entry_json(error); });
  json["error_estimate"] = errors;
  return json;
}

/// Whether rounding or the method's error has outgrown the row by itself; what follows such a row is no better.
bool doubtful(const Scene& scene, const ImpactRecord& row) {
  const double gap_of_method = std::max(1e-6, std::pow(10.0, -scene.options.digits));
  if (!row.predictable || !(std::fabs(row.ledger_gap) <= gap_of_method)) return true;
  if (!scene.options.error_estimates) return false;
  return !(row.error.impulse.norm() <= 0.05 * row.value.impulse.norm());
}

/// The number of impacts before the first doubtful one.
std::size_t trusted_impacts(const Scene& scene, const Simulation& run) {
  const auto first = std::find_if(run.impacts.begin(), run.impacts.end(),
                                  [&](const ImpactRecord& row) { return doubtful(scene, row); });
  return static_cast<std::size_t>(first - run.impacts.begin());
}

/// What is known of the numbers of an impact: the digits that their estimated errors leave, none in a row that is not
/// to be trusted.  Without estimates (run.errors = false) two digits, which a tolerance of 1e-4 and less leaves.
class Known {
 public:
  Known(const Scene& scene, bool trusted) : scene_(scene), trusted_(trusted) {}

  [[nodiscard]] Cell operator()(double value, double error, double size) const {
    if (!trusted_) return {value, 0};
    if (!scene_.options.error_estimates) return {value, digits_without_estimate};
    return known_cell({value, error}, {scene_.options.digits, size});
  }

 private:
  static constexpr int digits_without_estimate = 2;
  const Scene& scene_;
  bool trusted_;
};

/// Sizes of the numbers of a run, by their places in MotionNumbers.
struct Sizes {
  double time, angle, impulse, speed, rate;
  explicit Sizes(const MotionNumbers& all)
      : time(all[0]), angle(all[1]), impulse(all[4]), speed(all[7]), rate(all[9]) {}
};

/// The sum of the normal impulses as far as it is known.
std::string total_words(const Scene& scene, const PlannedRun& planned) {
  const Estimated total = totals(planned.run).normal_impulse;
  const bool trusted = trusted_impacts(scene, planned.run) == planned.run.impacts.size();
  return shown_text(Known(scene, trusted)(total.value, total.error, 0));
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
  const auto first = run.impacts.begin() + static_cast<std::ptrdiff_t>(last_trusted);
  const std::string growth = first->predictable ? "after it a second run goes another way"
                                                : fmt::format("an error of the start has grown {} times by then",
                                                              significant(first->amplification, 2));
  return last_trusted == 0 ? fmt::format("?: not to be trusted: {}", growth)
                           : fmt::format("?: trust ends with impact {}: {}", last_trusted, growth);
}

/// What was asked against what came out, by the estimates.
std::string accuracy_words(const Scene& scene, const PlannedRun& planned) {
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

/// What the scene's law of friction leaves out, if that exceeds the digits asked.
std::string local_slip_words(const Scene& scene, const Simulation& run) {
  double largest = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < run.impacts.size(); ++i) {
    largest = std::max(largest, run.impacts[i].value.impulse.norm());
    if (run.impacts[i].local_slip > run.impacts[worst].local_slip) worst = i;
  }
  if (run.impacts.empty() || !(run.impacts[worst].local_slip > std::pow(10.0, -scene.options.digits) * largest))
    return "";
  return fmt::format(
      "coulomb takes the patch as flat: with each place's own slip (friction_law = \"local\") the tangential "
      "impulse of impact {} would change by about {} N·s, and what follows with it",
      worst + 1, significant(run.impacts[worst].local_slip, 1));
}

std::vector<std::string> notes_of(const Scene& scene, const PlannedRun& planned) {
  const Simulation& run = planned.run;
  std::vector<std::string> notes;
  const std::string trust = trust_words(scene, run);
  if (!trust.empty()) notes.push_back(trust);
  for (const std::string& warning : planned.warnings) notes.push_back("!: warning: " + warning);
  double gap = 0;
  for (const ImpactRecord& row : run.impacts) gap = std::max(gap, std::fabs(row.ledger_gap));
  if (!run.impacts.empty()) {
    notes.push_back(fmt::format("Sum of normal impulses: {} N·s; the ledger of energy closes to {}",
                                total_words(scene, planned), significant(gap, 1)));
  }
  const std::string local_slip = local_slip_words(scene, run);
  if (!local_slip.empty()) notes.push_back(local_slip);
  notes.push_back(method_words(run));
  const std::string accuracy = accuracy_words(scene, planned);
  if (!accuracy.empty()) notes.push_back(accuracy);
  notes.push_back(fmt::format("{}: {}", outcome_name(run.outcome), run.message));
  return notes;
}

std::vector<std::string> head_of(const Scene& scene, const std::string& what) {
  std::vector<std::string> head{headline("simulate", what)};
  for (const std::string& line : scene_head(scene)) head.push_back(line);
  return head;
}

const char* const what_it_is = "impact sequence, continuous contact";

Cell loss_cell(const Known& known, const Simulation& run, const ImpactRecord& row) {
  const double percent = 100 / run.energy_start;
  return known(row.value.energy_loss * percent, row.error.energy_loss * percent, 100);
}

Json shortfall_json(const Scene& scene, const PlannedRun& planned) {
  const std::string why = shortfall(scene, planned);
  return why.empty() ? Json(nullptr) : Json(why);
}

Json quantity_json(const Scene& scene, const SweptRun& swept) {
  Json json{{scene.sweep->name(), swept.value},
            {"outcome", outcome_name(swept.planned.run.outcome)},
            {"message", swept.planned.run.message},
            {"shortfall", shortfall_json(scene, swept.planned)}};
  json["impacts"] = Json::array();
  int n = 0;
  for (const ImpactRecord& row : swept.planned.run.impacts) json["impacts"].push_back(impact_json(row, ++n));
  return json;
}

}  // namespace

Table simulation_table(const Scene& scene, const PlannedRun& planned) {
  const Simulation& run = planned.run;
  const bool friction = scene.ground.has_friction();
  const bool loses = friction || scene.ground.damping > 0;
  Table table{.head = head_of(scene, what_it_is), .columns = {}, .rows = {}, .notes = notes_of(scene, planned)};
  table.columns = {{"n", "n", ""},
                   {"end", "end", ""},
                   {"start", "t", "s"},
                   {"duration", "contact", "s", !friction},
                   {"contact_angle_deg", "angle", "°"},
                   {"impulse_normal", "Pₙ", "N·s"},
                   {"impulse_tangential", "Pₜ", "N·s", friction},
                   {"peak_force", "peak Fₙ", "N"},
                   {"velocity_after_z", "Vₙ", "m/s"},
                   {"angular_velocity_after_y", "Ω", "rad/s"},
                   {"energy_loss", "loss", "%", loses}};
  const std::size_t trust = trusted_impacts(scene, run);
  const Sizes sizes(planned.sizes);
  std::size_t n = 0;
  for (const ImpactRecord& row : run.impacts) {
    const ImpactNumbers &v = row.value, &e = row.error;
    const bool trusted_row = ++n <= trust;
    const Known cell(scene, trusted_row);
    table.rows.push_back(
        {Cell(std::to_string(n) + (trusted_row ? "" : "?") + (row.submerged ? "!" : "")), Cell(end_name(row.end)),
         cell(v.start, e.start, sizes.time), cell(v.duration, e.duration, sizes.time),
         cell(v.contact_angle * degrees, e.contact_angle * degrees, sizes.angle),
         cell(v.impulse.z(), e.impulse.z(), sizes.impulse), cell(v.impulse.x(), e.impulse.x(), sizes.impulse),
         cell(v.peak_force, e.peak_force, 0), cell(v.velocity_after.z(), e.velocity_after.z(), sizes.speed),
         cell(v.angular_velocity_after.y(), e.angular_velocity_after.y(), sizes.rate), loss_cell(cell, run, row)});
  }
  fit_columns(table, scene.options.digits, {2});
  return table;
}

Json simulation_json(const Scene& scene, const PlannedRun& planned) {
  const Simulation& run = planned.run;
  Json json{{"clatter", version},
            {"model", "continuous"},
            {"scene", scene.json()},
            {"body", body_json(scene)},
            {"impacts", Json::array()}};
  int n = 0;
  for (const ImpactRecord& row : run.impacts) json["impacts"].push_back(impact_json(row, ++n));
  json["outcome"] = outcome_name(run.outcome);
  json["warnings"] = planned.warnings;
  json["message"] = run.message + "; restitution is null where an impact has several touches";
  const std::string local_slip = local_slip_words(scene, run);
  json["notes"] = local_slip.empty() ? Json::array() : Json::array({local_slip});
  json["method"] = method_name(run.method);
  json["tolerance"] = run.tolerance > 0 ? Json(run.tolerance) : Json(nullptr);
  json["step"] = run.step > 0 ? Json(run.step) : Json(nullptr);
  json["accuracy"] = {{"asked", planned.asked},
                      {"achieved", number_or_null(planned.achieved)},
                      {"known_impacts", planned.known_impacts},
                      {"planned", planned.planned}};
  const Totals sums = totals(run);
  json["total_normal_impulse"] = number_or_null(sums.normal_impulse.value);
  json["total_normal_impulse_error"] = error_or_null(sums.normal_impulse);
  json["predictable"] = sums.predictable;
  json["shortfall"] = shortfall_json(scene, planned);
  json["energy_start"] = number_or_null(run.energy_start);
  json["cost"] = {{"force_evaluations", run.force_evaluations}, {"root_evaluations", run.root_evaluations}};
  return json;
}

Table simulation_records(const Scene& scene, const PlannedRun& planned) {
  const Json json = simulation_json(scene, planned);
  Table table{
      .head = {headline("simulate", what_it_is), "scene: " + json["scene"].dump(), "body: " + json["body"].dump()},
      .columns = {},
      .rows = {},
      .notes = notes_of(scene, planned)};
  table.notes.insert(table.notes.begin(), total_note(json));
  add_impact_records(table, json["impacts"]);
  return table;
}

Table sweep_table(const Scene& scene, const std::vector<SweptRun>& runs) {
  Table table{.head = head_of(scene, "first impacts, continuous contact"), .columns = {}, .rows = {}, .notes = {}};
  table.columns = {swept_column(*scene.sweep),
                   {"touches", "touches", ""},
                   {"impulse_normal", "Pₙ", "N·s"},
                   {"impulse_ratio", "Pₜ/Pₙ", ""},
                   {"velocity_after_x", "Vₜ", "m/s"},
                   {"velocity_after_z", "Vₙ", "m/s"},
                   {"angular_velocity_after_y", "Ω", "rad/s"},
                   {"peak_force", "peak Fₙ", "N"},
                   {"energy_loss", "loss", "%"}};
  for (const SweptRun& swept : runs) {
    auto& row = table.rows.emplace_back();
    row.emplace_back(swept.value, 6);
    const Simulation& run = swept.planned.run;
    if (run.impacts.empty()) {
      row.emplace_back(std::string(outcome_name(run.outcome)));
      row.resize(table.columns.size());
      continue;
    }
    const ImpactRecord& first = run.impacts[0];
    const ImpactNumbers &v = first.value, &e = first.error;
    const Known known(scene, trusted_impacts(swept.scene, run) > 0);
    const Sizes sizes(swept.planned.sizes);
    row.emplace_back(std::to_string(first.touches));
    row.push_back(known(v.impulse.z(), e.impulse.z(), sizes.impulse));
    row.push_back(known(impulse_ratio(v), impulse_ratio_error(first), 1));
    row.push_back(known(v.velocity_after.x(), e.velocity_after.x(), sizes.speed));
    row.push_back(known(v.velocity_after.z(), e.velocity_after.z(), sizes.speed));
    row.push_back(known(v.angular_velocity_after.y(), e.angular_velocity_after.y(), sizes.rate));
    row.push_back(known(v.peak_force, e.peak_force, 0));
    row.push_back(loss_cell(known, run, first));
  }
  if (!runs.empty()) table.notes.push_back(method_words(runs.back().planned.run) + " (the last row's)");
  add_interruption(*scene.sweep, runs.size(), table);
  fit_columns(table, scene.options.digits, {2});
  return table;
}

Json sweep_json(const Scene& scene, const std::vector<SweptRun>& runs) {
  Json json{{"clatter", version},
            {"model", "continuous"},
            {"scene", scene.json()},
            {"body", body_json(scene)},
            {"runs", Json::array()}};
  for (const SweptRun& swept : runs) json["runs"].push_back(quantity_json(scene, swept));
  const std::size_t values = scene.sweep->values().size();
  json["outcome"] = runs.size() < values ? "interrupted" : "complete";
  json["message"] = fmt::format("{} of {} values", runs.size(), values);
  return json;
}

Table sweep_records(const Scene& scene, const std::vector<SweptRun>& runs) {
  Table table{.head = {headline("simulate", "impacts over a sweep, continuous contact"),
                       "scene: " + scene.json().dump(), "body: " + body_json(scene).dump()},
              .columns = {},
              .rows = {},
              .notes = {}};
  for (const SweptRun& swept : runs) {
    const std::size_t before = table.rows.size();
    add_impact_records(table, quantity_json(scene, swept)["impacts"]);
    for (std::size_t i = before; i < table.rows.size(); ++i) {
      table.rows[i].insert(table.rows[i].begin(), Cell(swept.value, 17));
    }
    const Simulation& run = swept.planned.run;
    if (run.impacts.empty() || is_cut_short(run.outcome)) {
      table.notes.push_back(fmt::format("{}: {}: {}", shortest(swept.value), outcome_name(run.outcome), run.message));
    }
  }
  add_interruption(*scene.sweep, runs.size(), table);
  table.columns.insert(table.columns.begin(), swept_record_column(*scene.sweep));
  return table;
}

}  // namespace clatter::validation
