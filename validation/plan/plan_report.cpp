// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation {
namespace {

std::string error_words(double error) { return std::isfinite(error) ? significant(error, 2) : "too large to tell"; }

std::string within_words(const Plan& plan) {
  return plan.target.within_ms ? fmt::format(" within {} ms", shortest(*plan.target.within_ms)) : "";
}

std::string summary_of(const Plan& plan) {
  if (plan.target.most_accurate) return "the most accurate model" + within_words(plan);
  return fmt::format("the smallest model that gives {} digits{}", plan.target.digits, within_words(plan));
}

std::string setting_words(const LevelSetting& setting) {
  if (!is_continuous(setting.level)) return "";
  return fmt::format("{} {}", method_name(setting.method), significant(setting.tolerance, 1));
}

bool is_choice(const WeighedLevel& level, const Plan& plan) { return level.level == plan.choice.level; }

std::string verdict(const WeighedLevel& level, const Plan& plan) {
  if (!level.against.empty()) return "does not apply";
  if (is_choice(level, plan)) return level.serves ? "chosen" : "the best there is";
  return level.serves ? "serves" : "not accurate enough";
}

std::string choice_words(const Plan& plan) {
  const std::string setting = setting_words(plan.choice);
  return fmt::format("Choice: {}{}{}, error {}, {} ms", level_name(plan.choice.level), setting.empty() ? "" : ", ",
                     setting, error_words(plan.error), significant(1e3 * plan.seconds, 2));
}

/// What the estimates of errors add to the choice, and which keys turn them off; empty: the scene asks for none.
std::string price_words(const Plan& plan) {
  if (!(plan.evaluations_with_estimates > 0)) return "";
  const numeric::Request& request = plan.scene.request;
  const bool both = request.error_estimates && request.amplification;
  const auto [what, keys] = both
                                ? std::pair("error estimates and the growth of errors", "run.errors, run.amplification")
                            : request.error_estimates ? std::pair("error estimates", "run.errors")
                                                      : std::pair("the growth of errors", "run.amplification");
  return fmt::format("With {}: {} ms, {} times the force evaluations; {} = false leaves them out", what,
                     significant(1e3 * plan.seconds_with_estimates, 2),
                     significant(plan.evaluations_with_estimates / plan.evaluations, 2), keys);
}

std::string measured_words(const Plan& plan) {
  if (plan.simulate_evaluations == 0) return "";
  return fmt::format(
      "Measured: clatter simulate, as each scene of a sweep, finds its own setting and took {} ms, {} force "
      "evaluations; "
      "probes and other attitudes may take many times that, which clatter sweep --scenes 0:9 tells",
      significant(1e3 * plan.simulate_seconds, 2), plan.simulate_evaluations);
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
  return fmt::format(
      "{}: {}",
      left_out ? "Left out, with the error that this brings" : "Kept, with the error that to leave it out would bring",
      words);
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

Row level_row(const WeighedLevel& level, const Plan& plan) {
  const bool applies = level.against.empty();
  const bool continuous = is_continuous(level.level) && applies;
  const Value none;
  return {Cell(level_name(level.level)),
          Cell(continuous ? Value(method_name(level.setting.method)) : none),
          continuous ? Cell(level.setting.tolerance, 1) : Cell(),
          Cell(level.error, 2),
          applies ? Cell(level.evaluations, continuous ? fmt::format("{:.0f}", level.evaluations) : "") : Cell(),
          applies ? Cell(level.seconds, 2) : Cell(),
          Cell(level_assumption(level.level, plan.scene.world.ground)),
          Cell(rounded_up(level.assumption_error)),
          Cell(level.serves),
          Cell(verdict(level, plan)),
          Cell(text_or_nothing(level.against))};
}

Value choice_fields(const Plan& plan) {
  const bool continuous = is_continuous(plan.choice.level);
  const auto positive = [](double number) { return number > 0 ? Value(number) : Value(); };
  return Value::Fields{{"model", level_name(plan.choice.level)},
                       {"method", continuous ? Value(method_name(plan.choice.method)) : Value()},
                       {"tolerance", continuous ? Value(plan.choice.tolerance) : Value()},
                       {"error", plan.error},
                       {"force_evaluations", plan.evaluations},
                       {"seconds", plan.seconds},
                       {"force_evaluations_with_estimates", positive(plan.evaluations_with_estimates)},
                       {"seconds_with_estimates", positive(plan.seconds_with_estimates)},
                       {"serves", plan.serves},
                       {"command", command_line(plan)}};
}

/// What the plan takes for granted where it uses a level, or why a level does not apply.
std::string level_words(const WeighedLevel& level, const Plan& plan) {
  const std::string name = level_name(level.level);
  if (!level.against.empty()) return name + " does not apply: " + level.against;
  if (!std::isfinite(level.assumption_error)) return "";
  if (level.level == ModelLevel::planar) return plane_words(plan);
  return fmt::format("{} takes for granted: {}; an error of {} is expected from that", name,
                     level_assumption(level.level, plan.scene.world.ground), error_words(level.assumption_error));
}

std::vector<std::string> notes_of(const Plan& plan) {
  const std::string shortfall = plan_shortfall(plan);
  const bool has_choice = !std::isnan(plan.error);
  std::vector<std::string> notes{has_choice ? choice_words(plan) : "", price_words(plan),
                                 shortfall.empty() ? "" : "Not as asked: " + shortfall,
                                 has_choice ? "Run it: " + command_line(plan) : "", measured_words(plan)};
  for (const WeighedLevel& level : plan.levels) notes.push_back(level_words(level, plan));
  notes.insert(notes.end(),
               {parts_words(plan, true), parts_words(plan, false),
                fmt::format("Errors: the largest over {} and all times, angles, impulses and velocities, relative to "
                            "the sequence's sizes",
                            plan.impacts == 1 ? "one impact" : fmt::format("{} impacts", plan.impacts)),
                fmt::format("Planning took {} force evaluations", plan.planning_evaluations)});
  std::erase(notes, "");
  return notes;
}

void add_results(const Plan& plan, Value& fields) {
  fields["parts"] = Value::List{};
  for (const WeighedPart& part : plan.parts) {
    fields["parts"].push_back(
        Value::Fields{{"part", part_name(part.part)}, {"error", part.error}, {"left_out", part.left_out}});
  }
  fields["impacts"] = plan.impacts;
  fields["known_impacts"] = plan.known_impacts;
  fields["predictable_impacts"] = plan.predictable_impacts;
  fields["growth_out_of_plane"] = plan.growth_out_of_plane;
  fields["error_constant"] = plan.error_constant;
  fields["simulate_seconds"] = plan.simulate_seconds;
  fields["simulate_evaluations"] = plan.simulate_evaluations;
  fields["planning_evaluations"] = plan.planning_evaluations;
  const std::string shortfall = plan_shortfall(plan);
  fields["shortfall"] = text_or_nothing(shortfall);
  fields["message"] = shortfall.empty() ? choice_words(plan) : shortfall;
}

/// What an axis must show.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  void take(double number) { low = std::min(low, number), high = std::max(high, number); }
};

/// A mark for each model that has a cost and an error.
void add_models(const Plan& plan, PicturePanel& panel, Extent& cost, Extent& error) {
  for (const WeighedLevel& level : plan.levels) {
    if (!level.against.empty() || !(level.error > 0) || !(level.seconds > 0) || !std::isfinite(level.error)) continue;
    const double curve = static_cast<double>(panel.plot.curves.size());
    const std::string setting = setting_words(level.setting);
    panel.rows.push_back({curve, 1e3 * level.seconds, level.error});
    panel.plot.curves.push_back({.x = "cost",
                                 .y = "error",
                                 .legend = fmt::format("{}{}{}: {}", level_name(level.level),
                                                       setting.empty() ? "" : ", ", setting, verdict(level, plan)),
                                 .style = FigureCurve::Style::marks,
                                 .where = {{"curve", curve}}});
    cost.take(1e3 * level.seconds), error.take(level.error);
  }
}

struct Limit {
  double number;  ///< of its curve
  std::string words;
  std::array<double, 2> cost, error;  ///< of its ends
};

void add_limit(const Limit& limit, PicturePanel& panel) {
  for (const std::size_t k : {0, 1}) panel.rows.push_back({limit.number, limit.cost[k], limit.error[k]});
  panel.plot.curves.push_back({.x = "cost",
                               .y = "error",
                               .legend = limit.words,
                               .style = FigureCurve::Style::dashed,
                               .where = {{"curve", limit.number}},
                               .colour = ink});
}

Picture plan_picture(const Scene& scene, const Plan& plan) {
  PicturePanel panel{.columns = {{"curve", "1", "number of the model; -1: what is asked, -2: the time allowed"},
                                 {"cost", "ms", "predicted time"},
                                 {"error", "1", "predicted error"}},
                     .plot = {.x_label = "predicted cost [ms]",
                              .y_label = "predicted error, relative",
                              .legend_place = "beside",
                              .logarithmic_x = true,
                              .logarithmic_y = true}};
  const bool has_digits = plan.asked > 0 && !plan.target.most_accurate;
  const std::optional<double>& within = plan.target.within_ms;
  Extent cost, error;
  add_models(plan, panel, cost, error);
  if (has_digits) error.take(plan.asked);
  if (within) cost.take(*within);
  if (!(cost.high > 0)) cost.take(1);
  if (!(error.high > 0)) error.take(1);
  panel.plot.x = {cost.low / 3, 3 * cost.high}, panel.plot.y = {error.low / 10, 10 * error.high};
  const Range2 x = panel.plot.x, y = panel.plot.y;
  if (has_digits) {
    add_limit({-1, fmt::format("asked: {} digits", plan.target.digits), {x.low, x.high}, {plan.asked, plan.asked}},
              panel);
  }
  if (within)
    add_limit({-2, fmt::format("within {} ms", shortest(*within)), {*within, *within}, {y.low, y.high}}, panel);
  return {.what = "Models that were weighed: predicted cost and error", .scene = scene.summary(), .panels = {panel}};
}

std::vector<Column> plan_columns() {
  return {word_column("model", "model", "a model of the hierarchy"),
          word_column("method", "method", "of integration"),
          {"tolerance", "tol.", "", "of the method, per step"},
          {"error", "error", "", "largest over all impacts and numbers, relative to the sequence's sizes"},
          {"force_evaluations", "evals", "", "that a run takes"},
          {"seconds", "cost", "s", "that a run takes, predicted"},
          {"assumption", "", "", "what the model takes for granted", false},
          {"assumption_error", "", "", "the error that this brings, by the model's own account", false},
          {"serves", "", "", "whether the error is small enough", false},
          word_column("verdict", "verdict", "whether it serves or is chosen"),
          {"reason", "", "", "why it does not apply", false}};
}

}  // namespace

std::string plan_shortfall(const Plan& plan) {
  if (std::isnan(plan.error)) return "no impact could be computed: " + plan.pilot_ending;
  if (plan.cut_short) {
    return fmt::format("{} of {} impacts could be computed: {}", plan.impacts, plan.scene.request.impacts,
                       plan.pilot_ending);
  }
  if (plan.serves || plan.target.most_accurate) return "";
  const std::string best =
      fmt::format("the best is {} with an error of {}", level_name(plan.choice.level), error_words(plan.error));
  if (plan.known_impacts < plan.impacts) {
    return fmt::format("{} digits can be had of the first {} impacts only; over all {}", plan.target.digits,
                       plan.known_impacts, best);
  }
  return fmt::format("{} digits cannot be had{}; {}", plan.target.digits, within_words(plan), best);
}

Argument within_argument(std::optional<double>& within) {
  return number_argument("--within", within, {0, 1e9, true, "greater than 0, at most 1e9"}, "MS",
                         "that the run may take; alone: as accurate as fits");
}

PlanTarget plan_target(const Scene& scene, const PlanRequest& request) {
  PlanTarget target{.digits = scene.accuracy.digits};
  if (request.within) {
    target.within_ms = request.within;
    target.most_accurate = !request.is_given("digits");
  }
  for (const char* name : {"method", "tolerance", "step"}) {
    if (request.is_given(name)) throw BadInput("--{}: left out here: the plan chooses it", name);
  }
  if (request.is_given("history")) throw BadInput("--history: plan writes none; clatter simulate does");
  if (!scene.sweep) return target;
  throw BadInput("{}: a sweep has no plan; give --angle or leave out [sweep]", scene.path);
}

Report plan_report(const Scene& scene, const Plan& plan) {
  Report report = scene_report("plan", summary_of(plan), "plan", scene);
  report.grid.columns = plan_columns();
  for (const WeighedLevel& level : plan.levels) report.grid.rows.push_back(level_row(level, plan));
  report.notes = notes_of(plan);
  report.fields["asked"] = plan.asked;
  report.fields["within_ms"] = plan.target.within_ms ? Value(*plan.target.within_ms) : Value();
  report.fields["choice"] = std::isnan(plan.error) ? Value() : choice_fields(plan);
  report.fields["rungs"] = row_objects(report.grid);
  add_results(plan, report.fields);
  return report;
}

void require_counted_impacts(const Scene& scene, const char* command) {
  const auto refuse = [&](const char* key) {
    throw BadInput("{}: must be left out for clatter {}, which counts impacts", key, command);
  };
  require_level(scene, command);
  if (std::isfinite(scene.request.until)) refuse("run.until");
  if (scene.request.starts_on_ground) refuse("drop.start = \"rest\"");
}

namespace {

struct PlanInput {
  SceneFlags scene;
  std::optional<double> within;  ///< [ms]
  OutputChoice output;
  PlotChoice plot;
};

int run_plan(const PlanInput& input) {
  const Scene scene = read_scene_flags(input.scene);
  require_counted_impacts(scene, "plan");
  const OutputChoice& choice = input.output;
  const auto is_typed = [&](const std::string& name) { return is_given(input.scene, "--" + name); };
  const PlanTarget target = plan_target(scene, {input.within, is_typed});
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  Plan plan = make_plan(scene, target);
  plan.given = overrides_of(input.scene);
  write_report(choice, plan_report(scene, plan));
  plot.write(plan_picture(scene, plan), run_words("plan", "the smallest model that serves", scene));
  return status_of(plan_shortfall(plan));
}

}  // namespace

Command plan_command() {
  return command_of<PlanInput>(run_plan, [](Command& command, PlanInput& input) {
    add_scene_flags(command, input.scene);
    command.add(within_argument(input.within));
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer =
        "Example: clatter plan phone-damped --digits 4\n"
        "Exit status 3 if no model gives the digits; the best is shown all the same.";
    command.columns = {{"plan", plan_columns}};
  });
}

}  // namespace clatter::validation
