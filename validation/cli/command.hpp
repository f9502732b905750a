// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program, described as data: parser, help, completion scripts and manual page are made from it; and
// all commands there are.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace clatter::validation::inline cli {

/// What a command accepts, and where its text goes; the command checks the text itself.
struct Argument {
  /// A truth is a flag without a value; a list takes many values.
  using Target = std::variant<bool*, std::string*, std::optional<std::string>*, std::vector<std::string>*>;

  std::string name;  ///< "--angle", or "SCENE" for an argument known by its place
  Target target;
  std::string type;  ///< of the value, in help: "DEG", "a|b|c" (shells offer these), "FILE" (shells offer files)
  std::string help;
  std::string group{};  ///< heading in help; empty: "Options"
  bool required = false;
  bool repeats = false;  ///< a list that takes one value each time the option is given

  [[nodiscard]] bool is_option() const { return name.starts_with("--"); }
  [[nodiscard]] bool is_flag() const { return std::holds_alternative<bool*>(target); }
  [[nodiscard]] bool is_list() const { return std::holds_alternative<std::vector<std::string>*>(target) && !repeats; }
  /// What the value is chosen from; empty where it is not.
  [[nodiscard]] std::vector<std::string> choices() const;
};

struct Command {
  std::string name;
  std::string help;      ///< one line
  std::string footer{};  ///< an example, and what else to know
  std::vector<Argument> arguments{};
  std::function<int()> run{};  ///< after parsing; returns the exit status

  void add(Argument argument) { arguments.push_back(std::move(argument)); }
  void add_text(const std::string& option, std::optional<std::string>& text, const std::string& type,
                const std::string& words, const std::string& group = "") {
    add({.name = option, .target = &text, .type = type, .help = words, .group = group});
  }
  void add_flag(const std::string& option, bool& truth, const std::string& words, const std::string& group = "") {
    add({.name = option, .target = &truth, .type = "", .help = words, .group = group});
  }
  void add_list(const std::string& option, std::vector<std::string>& list, const std::string& type,
                const std::string& words) {
    add({.name = option, .target = &list, .type = type, .help = words});
  }
  /// Names of the options, --help first.
  [[nodiscard]] std::vector<std::string> option_names() const;
};

// The commands of the program.

[[nodiscard]] Command sequence_command();
[[nodiscard]] Command angles_command();
[[nodiscard]] Command regimes_command();
[[nodiscard]] Command atlas_command();
[[nodiscard]] Command explain_command();
[[nodiscard]] Command gradient_command();
[[nodiscard]] Command simulate_command();
[[nodiscard]] Command compare_command();
[[nodiscard]] Command shock_command();
[[nodiscard]] Command ground_command();
[[nodiscard]] Command report_command();
[[nodiscard]] Command sweep_command();
[[nodiscard]] Command map_command();
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
