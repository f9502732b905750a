#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/plan_report.hpp"
#include "validation/cli/scene_flags.hpp"
#include "validation/output/message.hpp"
#include "validation/scene/bad_input.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {
namespace {

struct PlanInput {
  SceneFlags scene;
  std::optional<std::string> within;
  OutputTexts output;
};

PlanTarget read_target(const PlanInput& input, const Scene& scene) {
  PlanTarget target{.digits = scene.options.digits};
  if (!input.within) return target;
  target.within_ms = read_number_option("--within", *input.within, {0, 1e9, true, "greater than 0"});
  target.most_accurate = !is_given(input.scene, "--digits");
  return target;
}

void refuse_what_it_plans(const PlanInput& input) {
  for (const char* name : {"--method", "--tolerance", "--step"}) {
    if (is_given(input.scene, name)) throw BadInput(fmt::format("{}: left out here: the plan chooses it", name));
  }
  if (is_given(input.scene, "--history")) throw BadInput("--history: plan writes none; clatter simulate does");
}

int run_plan(const PlanInput& input) {
  const Scene scene = read_scene_flags(input.scene);
  const OutputChoice choice = read_output(input.output);
  const PlanTarget target = read_target(input, scene);
  refuse_what_it_plans(input);
  check_files(choice, {}, files_of(scene));
  if (scene.sweep) {
    throw BadInput(fmt::format("{}: a sweep has no plan; give --angle or leave out [sweep]", scene.path));
  }
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
      "Example: clatter plan validation/cases/phone-damped.toml --digits 4\n"
      "Exit status 3 if no model gives the digits; the best is shown all the same.";
  command.run = [input] { return run_plan(*input); };
  return command;
}

}  // namespace clatter::validation
