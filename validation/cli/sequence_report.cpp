#include "validation/cli/sequence_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/cli/impact_records.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/impact_entries.hpp"
#include "validation/output/names.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using analytic::degrees_per_radian;
using analytic::ImpactRow;
using analytic::Sequence;

const char* const no_history =
    "the discrete model's impacts are instantaneous: no peak force or time";

Json impact_json(const Scene& scene, const ImpactRow& row, int n) {
  Json json;
  for_each_entry(row, n, scene.angle_deg, [&](const char* name, const auto& value) { json[name] = entry_json(value); });
  const analytic::RowErrors& error = row.error;
  json["error_estimate"] = {{"start", number_or_null(error.start)},
                            {"inclination_deg", number_or_null(error.inclination * degrees_per_radian)},
                            {"contact_angle_deg", number_or_null(error.contact_angle * degrees_per_radian)},
                            {"approach_speed", number_or_null(error.approach_speed)},
                            {"impulse_normal", number_or_null(error.normal_impulse)},
                            {"impulse_tangential", number_or_null(error.tangential_impulse)}};
  json["predictable"] = error.predictable;
  json["amplification"] = number_or_null(row.amplification);
  return json;
}

Json tail_json(const analytic::Tail& tail) {
  return {{"end", analytic::PlanarBody::vertex_set_name(tail.vertices)},
          {"end_time", tail.end_time},
          {"end_time_error", number_or_null(tail.end_time_error)},
          {"impulse_normal", tail.normal_impulse},
          {"impulse_normal_error", number_or_null(tail.normal_impulse_error)},
          {"impulse_tangential", tail.tangential_impulse},
          {"impulse_tangential_error", number_or_null(tail.tangential_impulse_error)},
          {"closed_form", tail.closed_form},
          {"velocity_after", {tail.after.tangential, 0.0, tail.after.normal}},
          {"angular_velocity_after", {0.0, tail.after.angular, 0.0}}};
}

Cell known(const Scene& scene, double value, double error) {
  return {value, std::min(scene.digits, known_digits(value, error))};
}

bool with_friction(const Scene& scene) {
  return scene.law.friction != analytic::FrictionKind::none;
}

bool loses_energy(const Sequence& sequence) {
  return std::any_of(sequence.rows.begin(), sequence.rows.end(), [&](const ImpactRow& row) {
    return std::fabs(row.impact.energy_loss) > 1e-14 * sequence.rows[0].energy_before;
  });
}

/// Largest relative error of the rows' numbers; infinite if a row cannot be predicted.
double largest_rounding(const Sequence& sequence) {
  double worst = 0;
  for (const ImpactRow& row : sequence.rows) worst = std::max(worst, row.error.relative);
  return worst;
}

/// What was asked against what rounding leaves.
std::string accuracy_words(const Scene& scene, const Sequence& sequence) {
  const double rounding = largest_rounding(sequence);
  if (!std::isfinite(rounding)) return "";
  return fmt::format("asked {} digits, achieved {:.1f}: what rounding leaves", scene.digits,
                     std::max(-std::log10(rounding), 0.0));
}

std::vector<std::string> closing_notes(const Scene& scene, const Sequence& sequence) {
  std::vector<std::string> notes;
  if (sequence.tail) {
    const analytic::Tail& tail = *sequence.tail;
    const auto with_error = [&](double value, double error) {
      return significant(value, std::min(scene.digits + 3, known_digits(value, error))) +
             (error > 0 ? " ± " + significant(error, 2) : "");
    };
    notes.push_back(fmt::format("…: the last row sums up all further impacts; they end at {} s, {}",
                                with_error(tail.end_time, tail.end_time_error),
                                tail.closed_form ? "in closed form" : "by extrapolation"));
  }
  notes.push_back(fmt::format("Sum of normal impulses: {} N·s",
                              significant(sequence.total_normal_impulse, scene.digits)));
  const std::string accuracy = accuracy_words(scene, sequence);
  if (!accuracy.empty()) notes.push_back(accuracy);
  notes.push_back(fmt::format("{}: {}", outcome_name(sequence.outcome), sequence.message));
  if (sequence.outcome == analytic::Outcome::no_further_impact &&
      std::isfinite(sequence.near_miss.clearance)) {
    notes.push_back(fmt::format("closest approach after the last impact: {} m above the ground",
                                significant(sequence.near_miss.clearance, std::min(scene.digits, 6))));
  }
  return notes;
}

std::vector<std::string> head_of(const Scene& scene) {
  std::vector<std::string> head{headline("sequence", "impact sequence, discrete model")};
  for (const std::string& line : scene.summary()) head.push_back(line);
  return head;
}

}  // namespace

Table sequence_table(const Scene& scene, const Sequence& sequence) {
  const bool friction = with_friction(scene);
  Table table{.head = head_of(scene), .columns = {}, .rows = {}, .notes = closing_notes(scene, sequence)};
  table.columns = {{"n", "n", ""}, {"end", "end", ""}, {"start", "t", "s"},
                   {"contact_angle_deg", "angle", "°"}, {"impulse_normal", "Pₙ", "N·s"},
                   {"impulse_tangential", "Pₜ", "N·s", friction}, {"velocity_after_z", "Vₙ", "m/s"},
                   {"angular_velocity_after_y", "Ω", "rad/s"},
                   {"energy_loss", "loss", "J", !friction && loses_energy(sequence)},
                   {"mode", "mode", "", friction}};
  int n = 0;
  for (const ImpactRow& row : sequence.rows) {
    ++n;
    const analytic::RowErrors& error = row.error;
    const auto cell = [&](double value, double bound) { return known(scene, value, bound); };
    table.rows.push_back({Cell(std::to_string(n)), Cell(analytic::PlanarBody::vertex_set_name(row.vertices)),
                          cell(row.start, error.start),
                          cell(degrees_of(row.contact_angle, n, scene.angle_deg), error.contact_angle * degrees_per_radian),
                          cell(row.impact.normal_impulse, error.normal_impulse),
                          cell(row.impact.tangential_impulse, error.tangential_impulse),
                          cell(row.impact.after.normal, error.after.normal),
                          cell(row.impact.after.angular, error.after.angular),
                          cell(row.impact.energy_loss, error.energy_loss), Cell(mode_name(row.impact.mode))});
  }
  if (sequence.tail) {
    const analytic::Tail& tail = *sequence.tail;
    table.rows.push_back({Cell("…"), Cell(analytic::PlanarBody::vertex_set_name(tail.vertices)),
                          known(scene, tail.end_time, tail.end_time_error), Cell(),
                          known(scene, tail.normal_impulse, tail.normal_impulse_error),
                          known(scene, tail.tangential_impulse, tail.tangential_impulse_error),
                          known(scene, tail.after.normal, tail.after_error.normal),
                          known(scene, tail.after.angular, tail.after_error.angular),
                          Cell(), Cell()});
  }
  fit_columns(table, scene.digits, {5, 2});
  return table;
}

Json sequence_json(const Scene& scene, const Sequence& sequence) {
  Json json{{"clatter", version}, {"model", "discrete"}, {"scene", scene.json()},
            {"impacts", Json::array()}};
  int n = 0;
  for (const ImpactRow& row : sequence.rows) json["impacts"].push_back(impact_json(scene, row, ++n));
  if (sequence.tail) json["tail"] = tail_json(*sequence.tail);
  json["outcome"] = outcome_name(sequence.outcome);
  json["message"] = sequence.message + "; " + no_history;
  if (!sequence.warnings.empty()) json["warnings"] = sequence.warnings;
  if (sequence.outcome == analytic::Outcome::no_further_impact) {
    json["near_miss"] = {{"clearance", number_or_null(sequence.near_miss.clearance)},
                         {"margin", sequence.near_miss.margin},
                         {"within_margin", sequence.near_miss.within_margin()}};
  }
  json["accuracy"] = {{"asked", std::pow(10.0, -scene.digits)}, {"achieved", number_or_null(largest_rounding(sequence))}};
  json["total_normal_impulse"] = number_or_null(sequence.total_normal_impulse);
  json["total_normal_impulse_error"] = number_or_null(sequence.total_normal_impulse_error);
  json["cost"] = {{"force_evaluations", 0}, {"root_evaluations", sequence.root_evaluations}};
  return json;
}

Table sequence_records(const Scene& scene, const Sequence& sequence) {
  const Json json = sequence_json(scene, sequence);
  Table table{.head = {headline("sequence", "impact sequence, discrete model"),
                       "scene: " + json["scene"].dump()},
              .columns = {}, .rows = {},
              .notes = {"total_normal_impulse: " + shortest(sequence.total_normal_impulse),
                        fmt::format("{}: {}", outcome_name(sequence.outcome), sequence.message)}};
  add_impact_records(table, json["impacts"]);
  if (!json.contains("tail")) return table;
  const Json& tail = json["tail"];
  auto& row = table.rows.emplace_back();
  for (const Column& column : table.columns) {
    if (column.name == "n") row.push_back(Cell("tail"));
    else if (column.name == "start") row.push_back(json_cell(tail["end_time"]));
    else if (tail.contains(column.name)) row.push_back(json_cell(tail[column.name]));
    else row.emplace_back();
  }
  return table;
}

}  // namespace clatter::validation
