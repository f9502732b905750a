// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter gradient SCENE`: how the state after each impact changes with the drop.
#include <memory>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/gradient/gradient_report.hpp"
#include "validation/output/bad_input.hpp"

namespace clatter::validation {
namespace {

struct GradientInput {
  SceneFlags scene;
  OutputChoice output;
};

int run_gradient(const GradientInput& input) {
  const PreparedScene prepared = read_discrete_flags(input.scene);
  check_files(input.output);
  const GradientReport made = gradient_report(prepared);
  write_report(input.output, made.report);
  if (!made.shortfall.empty()) say(made.shortfall);
  return made.status;
}

}  // namespace

Command gradient_command() {
  auto input = std::make_shared<GradientInput>();
  Command command;
  add_scene_flags(command, input->scene, Model::discrete);
  add_output_options(command, input->output);
  command.footer =
      "Example: clatter gradient --angle 10 --gravity 9.81 --restitution 0.8 --impacts 3\n"
      "With respect to the angle and in space the tilt (per radian), the speed or height, restitution and\n"
      "friction. None at a fold, where an impact grazes, and where drops on both sides have other impacts:\n"
      "exit status 3.";
  command.run = [input] { return run_gradient(*input); };
  return command;
}

}  // namespace clatter::validation
