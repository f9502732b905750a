// The commands of the program.  Each adds its options to the parser and returns what runs it.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace clatter::validation {

/// Runs a command after parsing; returns the exit status.
using Action = std::function<int()>;

[[nodiscard]] Action add_sequence_command(CLI::App& app);
[[nodiscard]] Action add_angles_command(CLI::App& app);
[[nodiscard]] Action add_regimes_command(CLI::App& app);
[[nodiscard]] Action add_explain_command(CLI::App& app);
[[nodiscard]] Action add_simulate_command(CLI::App& app);
[[nodiscard]] Action add_compare_command(CLI::App& app);
[[nodiscard]] Action add_sweep_command(CLI::App& app);
[[nodiscard]] Action add_verify_command(CLI::App& app);
[[nodiscard]] Action add_figures_command(CLI::App& app);
[[nodiscard]] Action add_plan_command(CLI::App& app);
[[nodiscard]] Action add_tradeoff_command(CLI::App& app);
[[nodiscard]] Action add_extremes_command(CLI::App& app);
[[nodiscard]] Action add_demo_command(CLI::App& app);
[[nodiscard]] Action add_completion_command(CLI::App& app);
[[nodiscard]] Action add_man_command(CLI::App& app);

}  // namespace clatter::validation
