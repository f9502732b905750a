// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of the program.
#pragma once

#include <vector>

#include "validation/cli/command.hpp"

namespace clatter::validation::inline cli {

[[nodiscard]] Command sequence_command();
[[nodiscard]] Command angles_command();
[[nodiscard]] Command regimes_command();
[[nodiscard]] Command explain_command();
[[nodiscard]] Command simulate_command();
[[nodiscard]] Command compare_command();
[[nodiscard]] Command sweep_command();
[[nodiscard]] Command verify_command();
[[nodiscard]] Command figures_command();
[[nodiscard]] Command plan_command();
[[nodiscard]] Command tradeoff_command();
[[nodiscard]] Command extremes_command();
[[nodiscard]] Command benchmark_command();
[[nodiscard]] Command measured_command();
[[nodiscard]] Command demo_command();
[[nodiscard]] Command keys_command();
[[nodiscard]] Command columns_command();
[[nodiscard]] Command init_command();
[[nodiscard]] Command completion_command();
[[nodiscard]] Command man_command();

/// All of them, in the order of the help.
[[nodiscard]] const std::vector<Command>& all_commands();

}  // namespace clatter::validation::inline cli
