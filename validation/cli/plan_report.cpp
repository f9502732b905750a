#include "validation/cli/plan_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "validation/cli/impact_records.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

std::string error_words(double error) { return std::isfinite(error) ? significant(error, 2) : "too large to tell"; }

std::string what_it_is(const Plan& plan) {
  if (plan.target.most_accurate) {
    return fmt::format("the most accurate model within {} ms", shortest(*plan.target.within_ms));
  }
  const std::string within =
      plan.target.within_ms ? fmt::format(" within {} ms", shortest(*plan.target.within_ms)) : "";
  return fmt::format("the smallest model that gives {} digits{}", plan.target.digits, within);
}

std::string setting_words(const RungSetting& setting) {
  if (!is_continuous(setting.rung)) return "";
  return fmt::format("{} {}", method_name(setting.method), significant(setting.tolerance, 1));
}

bool is_choice(const WeighedRung& rung, const Plan& plan) { return rung.rung == plan.choice.rung; }

std::string verdict(const WeighedRung& rung, const Plan& plan) {
  if (!rung.against.empty()) return "does not apply";
  if (is_choice(rung, plan)) return rung.serves ? "chosen" : "the best there is";
  return rung.serves ? "serves" : "not accurate enough";
}

std::string choice_words(const Plan& plan) {
  const std::string setting = setting_words(plan.choice);
  return fmt::format("Choice: {}{}{}, error {}, {} ms", rung_name(plan.choice.rung), setting.empty() ? "" : ", ",
                     setting, error_words(plan.error), significant(1e3 * plan.seconds, 2));
}

std::string part_words(const WeighedPart& part) {
  if (part.part == Part::unmerged_faces) return "elements of flat faces (they change nothing)";
  return fmt::format("{} ({})", part_name(part.part), error_words(part.error));
}

/// "left out: …" or "kept: …" with what each part is worth; empty if there is none.
std::string parts_words(const Plan& plan, bool left_out) {
  std::string words;
  for (const WeighedPart& part : plan.parts) {
    if (part.left_out == left_out) words += (words.empty() ? "" : ", ") + part_words(part);
  }
  if (words.empty()) return "";
  return fmt::format("{}, with the error that this brings: {}", left_out ? "Left out" : "Not left out", words);
}

std::string plane_words(const Plan& plan) {
  if (!(plan.growth_out_of_plane > 10)) return "";
  const std::string growth =
      fmt::format("out of the plane an error of the start grows {:.0e} times", plan.growth_out_of_plane);
  if (plan.predictable_impacts >= plan.impacts) return "Planar: " + growth;
  return fmt::format(
      "Planar: {}; in space rounding leaves only {} of {} impacts known to what is asked, and the planar "
      "numbers hold for a body that is kept in its plane",
      growth, plan.predictable_impacts, plan.impacts);
}

void add_note(Table& table, const std::string& note) {
  if (!note.empty()) table.notes.push_back(note);
}

Json rung_json(const WeighedRung& rung, const Plan& plan) {
  const bool continuous = is_continuous(rung.rung) && rung.against.empty();
  return {{"model", rung_name(rung.rung)},
          {"method", continuous ? Json(method_name(rung.setting.method)) : Json(nullptr)},
          {"tolerance", continuous ? Json(rung.setting.tolerance) : Json(nullptr)},
          {"error", number_or_null(rung.error)},
          {"force_evaluations", rung.against.empty() ? Json(rung.evaluations) : Json(nullptr)},
          {"seconds", rung.against.empty() ? number_or_null(rung.seconds) : Json(nullptr)},
          {"assumption", rung_assumption(rung.rung)},
          {"assumption_error", number_or_null(rung.assumption_error)},
          {"serves", rung.serves},
          {"verdict", verdict(rung, plan)},
          {"reason", rung.against.empty() ? Json(nullptr) : Json(rung.against)}};
}

Json rungs_json(const Plan& plan) {
  Json rungs = Json::array();
  for (const WeighedRung& rung : plan.rungs) rungs.push_back(rung_json(rung, plan));
  return rungs;
}

Json choice_json(const Plan& plan) {
  const bool continuous = is_continuous(plan.choice.rung);
  return {{"model", rung_name(plan.choice.rung)},
          {"method", continuous ? Json(method_name(plan.choice.method)) : Json(nullptr)},
          {"tolerance", continuous ? Json(plan.choice.tolerance) : Json(nullptr)},
          {"error", number_or_null(plan.error)},
          {"force_evaluations", plan.evaluations},
          {"seconds", plan.seconds},
          {"serves", plan.serves},
          {"command", command_line(plan)}};
}

}  // namespace

std::string plan_shortfall(const Plan& plan) {
  if (std::isnan(plan.error)) return "no impact could be computed: " + plan.pilot_ending;
  if (plan.cut_short) {
    return fmt::format("{} of {} impacts could be computed: {}", plan.impacts, plan.scene.options.impacts,
                       plan.pilot_ending);
  }
  if (plan.serves || plan.target.most_accurate) return "";
  const std::string best =
      fmt::format("the best is {} with an error of {}", rung_name(plan.choice.rung), error_words(plan.error));
  if (plan.known_impacts < plan.impacts) {
    return fmt::format("{} digits can be had of the first {} impacts only; over all {}", plan.target.digits,
                       plan.known_impacts, best);
  }
  const std::string within =
      plan.target.within_ms ? fmt::format(" within {} ms", shortest(*plan.target.within_ms)) : "";
  return fmt::format("{} digits cannot be had{}; {}", plan.target.digits, within, best);
}

Table plan_table(const Scene& scene, const Plan& plan) {
  Table table{.head = {headline("plan", what_it_is(plan))}, .columns = {}, .rows = {}, .notes = {}};
  for (const std::string& line : scene_head(scene)) table.head.push_back(line);
  table.columns = {{.name = "model", .heading = "model", .unit = "", .words = true},
                   {.name = "setting", .heading = "setting", .unit = "", .words = true},
                   {"error", "error", ""},
                   {"force_evaluations", "evaluations", ""},
                   {"seconds", "cost", "ms"},
                   {.name = "verdict", .heading = "verdict", .unit = "", .words = true}};
  for (const WeighedRung& rung : plan.rungs) {
    const bool applies = rung.against.empty();
    const bool continuous = applies && is_continuous(rung.rung);
    table.rows.push_back({Cell(rung_name(rung.rung)), Cell(applies ? setting_words(rung.setting) : ""),
                          applies && std::isfinite(rung.error) ? Cell(rung.error, 2) : Cell(),
                          continuous ? Cell(fmt::format("{:.0f}", rung.evaluations)) : Cell(),
                          applies ? Cell(1e3 * rung.seconds, 2) : Cell(), Cell(verdict(rung, plan))});
  }
  const std::string shortfall = plan_shortfall(plan);
  if (!std::isnan(plan.error)) add_note(table, choice_words(plan));
  if (!shortfall.empty()) add_note(table, "Not as asked: " + shortfall);
  if (!std::isnan(plan.error)) add_note(table, "Run it: " + command_line(plan));
  for (const WeighedRung& rung : plan.rungs) {
    const std::string name = rung_name(rung.rung);
    if (!rung.against.empty()) add_note(table, name + " does not apply: " + rung.against);
    else if (rung.rung == Rung::planar && std::isfinite(rung.assumption_error)) add_note(table, plane_words(plan));
    else if (std::isfinite(rung.assumption_error))
      add_note(table, fmt::format("{} takes for granted: {}; by its own account an error of {}", name,
                                  rung.assumption_words, error_words(rung.assumption_error)));
  }
  add_note(table, parts_words(plan, true));
  add_note(table, parts_words(plan, false));
  add_note(table, fmt::format("Errors: the largest over {} and all times, angles, impulses and velocities, relative "
                              "to the sequence's sizes",
                              plan.impacts == 1 ? "one impact" : fmt::format("{} impacts", plan.impacts)));
  add_note(table, fmt::format("Planning took {} force evaluations", plan.planning_evaluations));
  return table;
}

Table plan_records(const Scene& scene, const Plan& plan) {
  Table table{
      .head = {headline("plan", what_it_is(plan)), "scene: " + scene.json().dump(), "body: " + body_json(scene).dump()},
      .columns = {},
      .rows = {},
      .notes = {}};
  add_impact_records(table, rungs_json(plan));
  if (!std::isnan(plan.error)) table.notes = {choice_words(plan), "Run it: " + command_line(plan)};
  return table;
}

Json plan_json(const Scene& scene, const Plan& plan) {
  Json json{
      {"clatter", version},    {"model", "plan"},
      {"scene", scene.json()}, {"body", body_json(scene)},
      {"asked", plan.asked},   {"within_ms", plan.target.within_ms ? Json(*plan.target.within_ms) : Json(nullptr)}};
  json["choice"] = std::isnan(plan.error) ? Json(nullptr) : choice_json(plan);
  json["rungs"] = rungs_json(plan);
  json["parts"] = Json::array();
  for (const WeighedPart& part : plan.parts) {
    json["parts"].push_back(
        {{"part", part_name(part.part)}, {"error", number_or_null(part.error)}, {"left_out", part.left_out}});
  }
  json["impacts"] = plan.impacts;
  json["known_impacts"] = plan.known_impacts;
  json["predictable_impacts"] = plan.predictable_impacts;
  json["growth_out_of_plane"] = number_or_null(plan.growth_out_of_plane);
  json["error_constant"] = number_or_null(plan.error_constant);
  json["planning_evaluations"] = plan.planning_evaluations;
  const std::string shortfall = plan_shortfall(plan);
  json["shortfall"] = shortfall.empty() ? Json(nullptr) : Json(shortfall);
  json["message"] = shortfall.empty() ? choice_words(plan) : shortfall;
  return json;
}

}  // namespace clatter::validation
