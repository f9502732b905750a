// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/commands.hpp"

namespace clatter::validation::inline cli {

const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands{
      sequence_command(), angles_command(),   regimes_command(),   explain_command(),    simulate_command(),
      compare_command(),  sweep_command(),    verify_command(),    figures_command(),    plan_command(),
      tradeoff_command(), extremes_command(), benchmark_command(), measured_command(),   demo_command(),
      keys_command(),     columns_command(),  init_command(),      completion_command(), man_command()};
  return commands;
}

}  // namespace clatter::validation::inline cli
