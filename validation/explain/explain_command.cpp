// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <utility>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/explain/explanation_report.hpp"
#include "validation/output/bad_input.hpp"

namespace clatter::validation {
namespace {

struct ExplainInput {
  int number = 1;
  SceneFlags scene;
  OutputChoice output;
};

int run_explain(const ExplainInput& input) {
  const PreparedScene scene = read_discrete_flags(input.scene);
  require_level(scene.scene, "explain");
  check_files(input.output);
  const Explanation explanation = explain_impact(scene, input.number);
  for (const std::string& warning : explanation.warnings) say(warning);
  write_out(input.output, explanation_text(explanation, input.output.style));
  if (explanation.shortfall.empty()) return 0;
  say(explanation.shortfall);
  return explanation.shortfall_status;
}

}  // namespace

Command explain_command() {
  auto input = std::make_shared<ExplainInput>();
  Command command;
  Argument number = whole_argument("N", input->number, 1, 1'000'000, "", "number of the impact, from 1");
  number.required = true;
  command.add(std::move(number));
  add_scene_flags(command, input->scene, Model::discrete);
  add_output_options(command, input->output);
  command.footer = "Example: clatter explain 2 --angle 10";
  command.run = [input] { return run_explain(*input); };
  return command;
}

}  // namespace clatter::validation
