// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/command.hpp"

namespace clatter::validation {

std::vector<std::string> Command::option_names() const {
  std::vector<std::string> names{"--help"};
  for (const Argument& argument : arguments) {
    if (argument.is_option()) names.push_back(argument.name);
  }
  return names;
}

const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands{
      sequence_command(), angles_command(),   regimes_command(),  atlas_command(),     explain_command(),
      gradient_command(), simulate_command(), compare_command(),  shock_command(),     ground_command(),
      report_command(),   sweep_command(),    map_command(),      verify_command(),    figures_command(),
      plan_command(),     tradeoff_command(), extremes_command(), benchmark_command(), measured_command(),
      demo_command(),     keys_command(),     columns_command(),  init_command(),      completion_command(),
      man_command()};
  return commands;
}

}  // namespace clatter::validation
