#include "validation/cli/sequence_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "validation/cli/impact_records.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/impact_entries.hpp"
#include "validation/output/names.hpp"
#include "validation/output/number.hpp"
#include "validation/output/totals.hpp"
#include "validation/plan/shortfall.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation {
namespace {

using analytic::degrees_per_radian;
using analytic::ImpactRow;
using analytic::Sequence;

const char* const no_history = "the discrete model's impacts are instantaneous: no peak force or time";

Json impact_json(const Scene& scene, const ImpactRow& row, int n) {
  Json json;
  for_each_entry(row, n, scene.angle_deg, [&](const char* name, const auto& value) { json[name] = entry_json(value); });
  Json errors = Json::object();
  for_each_error(row.error, [&](const char* name, const auto& error) { errors[name] = entry_json(error); });
  json["error_estimate"] = errors;
  json["amplification"] = number_or_null(row.amplification);
  json["predictable"] = row.error.predictable;
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

/// Sizes against which a number of the sequence counts as zero.
struct Sizes {
  double time = 0, impulse = 0, speed = 0, rate = 0, energy = 0;
};

Sizes sizes_of(const Sequence& sequence) {
  Sizes sizes;
  for (const ImpactRow& row : sequence.rows) {
    for (const analytic::PlanarVelocity& v : {row.before, row.impact.after}) {
      sizes.speed = std::max({sizes.speed, std::fabs(v.normal), std::fabs(v.tangential)});
      sizes.rate = std::max(sizes.rate, std::fabs(v.angular));
    }
    sizes.time = std::max(sizes.time, row.start);
    sizes.impulse = std::max({sizes.impulse, row.impact.normal_impulse, std::fabs(row.impact.tangential_impulse)});
    sizes.energy = std::max(sizes.energy, std::fabs(row.energy_before));
  }
  return sizes;
}

bool with_friction(const Scene& scene) { return impact_law(scene).friction != analytic::FrictionKind::none; }

bool loses_energy(const Sequence& sequence) {
  return std::any_of(sequence.rows.begin(), sequence.rows.end(), [&](const ImpactRow& row) {
    return std::fabs(row.impact.energy_loss) > 1e-14 * sequence.rows[0].energy_before;
  });
}

/// What was asked against what rounding leaves.
std::string accuracy_words(const Scene& scene, const Sequence& sequence) {
  const double error = largest_error(sequence);
  if (!std::isfinite(error)) return "";
  return fmt::format("asked {} digits, achieved {:.1f}: what rounding leaves", scene.options.digits,
                     std::max(-std::log10(error), 0.0));
}

std::string trust_words(const std::vector<ImpactRow>& rows) {
  const auto first =
      std::find_if(rows.begin(), rows.end(), [](const ImpactRow& row) { return !row.error.predictable; });
  if (first == rows.end()) return "";
  const auto known = first - rows.begin();
  return known == 0 ? "?: not to be trusted: how errors grow is not known"
                    : fmt::format("?: trust ends with impact {}: after it rounding decides what happens", known);
}

std::string with_error(const Estimated& number, const Shown& shown) {
  const std::string text = known_text(number, shown);
  return number.is_known() && number.error > 0 ? text + " ± " + significant(number.error, 2) : text;
}

std::string tail_words(const Scene& scene, const analytic::Tail& tail) {
  const Estimated end{tail.end_time, tail.end_time_error};
  return fmt::format("…: the last row sums up all further impacts; they end at {} s, {}",
                     with_error(end, {.digits = scene.options.digits + 3}),
                     tail.closed_form ? "in closed form" : "by extrapolation");
}

std::vector<std::string> closing_notes(const Scene& scene, const Sequence& sequence) {
  std::vector<std::string> notes;
  const auto add = [&](const std::string& note) {
    if (!note.empty()) notes.push_back(note);
  };
  if (sequence.tail) add(tail_words(scene, *sequence.tail));
  add(trust_words(sequence.rows));
  add(fmt::format("Sum of normal impulses: {} N·s",
                  known_text(totals(sequence).normal_impulse, {.digits = scene.options.digits})));
  add(accuracy_words(scene, sequence));
  add(fmt::format("{}: {}", outcome_name(sequence.outcome), sequence.message));
  const analytic::NearMiss& miss = sequence.near_miss;
  if (sequence.outcome == analytic::Outcome::no_further_impact && std::isfinite(miss.clearance)) {
    const analytic::RowErrors& last = sequence.rows.back().error;
    const Estimated clearance{miss.clearance, last.predictable ? miss.margin : last.start};
    add(fmt::format("closest approach after the last impact: {} m above the ground",
                    known_text(clearance, {.digits = std::min(scene.options.digits, 6)})));
  }
  return notes;
}

std::vector<Cell> impact_cells(const Scene& scene, const ImpactRow& row, const Sizes& sizes, int n) {
  const auto cell = [&](double value, double its_error, double size) {
    return known_cell({value, its_error}, {scene.options.digits, size});
  };
  const analytic::Impact& impact = row.impact;
  const analytic::RowErrors& error = row.error;
  return {Cell(std::to_string(n) + (error.predictable ? "" : "?")),
          Cell(analytic::PlanarBody::vertex_set_name(row.vertices)),
          cell(row.start, error.start, sizes.time),
          cell(degrees_of(row.contact_angle, n, scene.angle_deg), error.contact_angle * degrees_per_radian, 90),
          cell(impact.normal_impulse, error.normal_impulse, sizes.impulse),
          cell(impact.tangential_impulse, error.tangential_impulse, sizes.impulse),
          cell(impact.after.normal, error.after.normal, sizes.speed),
          cell(impact.after.angular, error.after.angular, sizes.rate),
          cell(impact.energy_loss, error.energy_loss, sizes.energy),
          Cell(mode_name(impact.mode))};
}

std::vector<Cell> tail_cells(const Scene& scene, const analytic::Tail& tail, const Sizes& sizes) {
  const auto cell = [&](double value, double error, double size) {
    return known_cell({value, error}, {scene.options.digits, size});
  };
  return {Cell("…"),
          Cell(analytic::PlanarBody::vertex_set_name(tail.vertices)),
          cell(tail.end_time, tail.end_time_error, sizes.time),
          Cell(),
          cell(tail.normal_impulse, tail.normal_impulse_error, sizes.impulse),
          cell(tail.tangential_impulse, tail.tangential_impulse_error, sizes.impulse),
          cell(tail.after.normal, tail.after_error.normal, sizes.speed),
          cell(tail.after.angular, tail.after_error.angular, sizes.rate),
          Cell(),
          Cell()};
}

std::vector<std::string> head_of(const Scene& scene) {
  std::vector<std::string> head{headline("sequence", "impact sequence, discrete model")};
  for (const std::string& line : scene_head(scene, Model::discrete)) head.push_back(line);
  return head;
}

}  // namespace

Table sequence_table(const Scene& scene, const Sequence& sequence) {
  const bool friction = with_friction(scene);
  Table table{.head = head_of(scene), .columns = {}, .rows = {}, .notes = closing_notes(scene, sequence)};
  table.columns = {{"n", "n", ""},
                   {"end", "end", ""},
                   {"start", "t", "s"},
                   {"contact_angle_deg", "angle", "°"},
                   {"impulse_normal", "Pₙ", "N·s"},
                   {"impulse_tangential", "Pₜ", "N·s", friction},
                   {"velocity_after_z", "Vₙ", "m/s"},
                   {"angular_velocity_after_y", "Ω", "rad/s"},
                   {"energy_loss", "loss", "J", !friction && loses_energy(sequence)},
                   {"mode", "mode", "", friction}};
  const Sizes sizes = sizes_of(sequence);
  int n = 0;
  for (const ImpactRow& row : sequence.rows) table.rows.push_back(impact_cells(scene, row, sizes, ++n));
  if (sequence.tail) table.rows.push_back(tail_cells(scene, *sequence.tail, sizes));
  fit_columns(table, scene.options.digits, {5, 2});
  return table;
}

Json sequence_json(const Scene& scene, const Sequence& sequence) {
  Json json{{"clatter", version},
            {"model", "discrete"},
            {"scene", scene.json(Model::discrete)},
            {"body", body_json(scene, Model::discrete)},
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
  json["accuracy"] = {{"asked", std::pow(10.0, -scene.options.digits)},
                      {"achieved", number_or_null(largest_error(sequence))}};
  const Totals sums = totals(sequence);
  json["total_normal_impulse"] = number_or_null(sums.normal_impulse.value);
  json["total_normal_impulse_error"] = error_or_null(sums.normal_impulse);
  json["predictable"] = sums.predictable;
  const std::string why = shortfall(scene, sequence);
  json["shortfall"] = why.empty() ? Json(nullptr) : Json(why);
  json["cost"] = {{"force_evaluations", 0}, {"root_evaluations", sequence.root_evaluations}};
  return json;
}

Table sequence_records(const Scene& scene, const Sequence& sequence) {
  const Json json = sequence_json(scene, sequence);
  Table table{.head = {headline("sequence", "impact sequence, discrete model"), "scene: " + json["scene"].dump(),
                       "body: " + json["body"].dump()},
              .columns = {},
              .rows = {},
              .notes = {total_note(json), fmt::format("{}: {}", outcome_name(sequence.outcome), sequence.message)}};
  add_impact_records(table, json["impacts"]);
  if (!json.contains("tail")) return table;
  const Json& tail = json["tail"];
  auto& row = table.rows.emplace_back();
  for (const Column& column : table.columns) {
    if (column.name == "n") row.push_back(Cell("tail"));
    else if (column.name == "start") row.push_back(json_cell(tail["end_time"]));
    else if (column.name == "start_error") row.push_back(json_cell(tail["end_time_error"]));
    else if (tail.contains(column.name)) row.push_back(json_cell(tail[column.name]));
    else row.emplace_back();
  }
  return table;
}

}  // namespace clatter::validation
