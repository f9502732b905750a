// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "validation/cli/command.hpp"
#include "validation/cli/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/reports/explanation_report.hpp"

namespace clatter::validation::inline cli {
namespace {

struct ExplainInput {
  std::string number;
  SceneFlags scene;
  OutputTexts output;
};

int run_explain(const ExplainInput& input) {
  const int n = read_integer_option("explain N", input.number, 1, 1000000);
  const PreparedScene scene = read_discrete_flags(input.scene);
  require_level(scene.scene, "explain");
  const OutputChoice choice = read_output(input.output);
  check_files(choice);
  const Explanation explanation = explain_impact(scene, n);
  for (const std::string& warning : explanation.warnings) say(warning);
  write_out(choice, explanation_text(explanation, choice.style));
  if (explanation.shortfall.empty()) return 0;
  say(explanation.shortfall);
  return explanation.shortfall_status;
}

}  // namespace

Command explain_command() {
  auto input = std::make_shared<ExplainInput>();
  Command command{.name = "explain", .help = "how impact N came about, step by step"};
  command.add(
      {.name = "N", .target = &input->number, .type = "", .help = "number of the impact, from 1", .required = true});
  add_scene_flags(command, input->scene, Model::discrete);
  add_output_options(command, input->output);
  command.footer = "Example: clatter explain 2 --angle 10";
  command.run = [input] { return run_explain(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
