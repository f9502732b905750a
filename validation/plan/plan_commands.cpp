// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter plan` and `clatter plan --tradeoff`: what accuracy costs.
#include <fmt/format.h>

#include <cmath>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/plan/plan_report.hpp"
#include "validation/plan/tradeoff_report.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {
namespace {

struct PlanInput {
  SceneFlags scene;
  std::optional<double> within;  ///< [ms]
  OutputChoice output;
  PlotChoice plot;
};

/// @throws BadInput for a scene that ends at a time, or that begins without an impact.
void require_counted_impacts(const Scene& scene, const char* command) {
  const auto refuse = [&](const char* key) {
    throw BadInput(fmt::format("{}: must be left out for clatter {}, which counts impacts", key, command));
  };
  if (std::isfinite(scene.request.until)) refuse("run.until");
  if (scene.request.starts_on_ground) refuse("drop.start = \"rest\"");
}

int run_plan(const PlanInput& input) {
  const Scene scene = read_scene_flags(input.scene);
  require_level(scene, "plan");
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
  const std::string shortfall = plan_shortfall(plan);
  if (shortfall.empty()) return 0;
  say(shortfall);
  return exit_status(FailureKind::not_computed);
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

namespace {

struct TradeoffInput {
  SceneFlags scene;
  OutputChoice output;
  PlotChoice plot;
};

int run_tradeoff(const TradeoffInput& input) {
  const Scene scene = read_scene_flags(input.scene);
  require_level(scene, "tradeoff");
  require_counted_impacts(scene, "tradeoff");
  const OutputChoice& choice = input.output;
  check_files(choice, plot_files(input.plot));
  if (scene.sweep)
    throw BadInput(fmt::format("{}: a sweep has no tradeoff; give --angle or leave out [sweep]", scene.path));
  PlotFile plot(input.plot);
  const CooperativeInterrupt interrupt;
  Tradeoff tradeoff;
  {
    Progress progress;
    TradeoffOptions options;
    options.progress = [&](std::size_t done, std::size_t of) {
      progress.show(progress_bar(done, of));
      return !interrupt.requested();
    };
    tradeoff = measure_tradeoff(scene, options);
  }
  Report report = tradeoff_report(scene, tradeoff);
  if (interrupt.requested()) note_interrupt("the models and settings that are not listed were not run", report);
  write_report(choice, report);
  if (interrupt.requested()) {
    plot.leave_out("interrupted");
    return interrupted_status;
  }
  plot.write(tradeoff_picture(scene, tradeoff), run_words("tradeoff", "cost against true error", scene));
  if (tradeoff.shortfall.empty()) return 0;
  say(tradeoff.shortfall);
  return exit_status(FailureKind::not_computed);
}

}  // namespace

Command tradeoff_command() {
  return command_of<TradeoffInput>(run_tradeoff, [](Command& command, TradeoffInput& input) {
    add_scene_flags(command, input.scene);
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer =
        "Example: clatter plan --tradeoff rod-45 --plot tradeoff.svg\n"
        "The table shows the front, --format csv all points.";
    command.columns = {{"tradeoff", tradeoff_columns}};
  });
}

}  // namespace clatter::validation
