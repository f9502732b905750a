// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/scene_flags.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/reports/plan_report.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation::inline cli {
namespace {

struct PlanInput {
  SceneFlags scene;
  std::optional<std::string> within;
  OutputTexts output;
};

int run_plan(const PlanInput& input) {
  const Scene scene = read_scene_flags(input.scene);
  const OutputChoice choice = read_output(input.output);
  const auto is_typed = [&](const std::string& name) { return is_given(input.scene, "--" + name); };
  const PlanTarget target = plan_target(scene, {input.within, is_typed});
  check_files(choice);
  const Plan plan = make_plan(scene, target);
  write_report(choice, plan_report(scene, plan));
  const std::string shortfall = plan_shortfall(plan);
  if (shortfall.empty()) return 0;
  say(shortfall);
  return exit_status(FailureKind::not_computed);
}

}  // namespace

Command plan_command() {
  auto input = std::make_shared<PlanInput>();
  Command command{.name = "plan", .help = "the smallest model that serves, and its cost"};
  add_scene_flags(command, input->scene);
  command.add_text("--within", input->within, "MS", "that the run may take; alone: as accurate as fits");
  add_output_options(command, input->output);
  command.footer =
      "Example: clatter plan phone-damped --digits 4\n"
      "Exit status 3 if no model gives the digits; the best is shown all the same.";
  command.run = [input] { return run_plan(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
