// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program, described as data: parser, help, completion scripts and manual page are made from it.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "validation/scene/argument.hpp"

namespace clatter::validation {

struct Command {
  std::string name{};    ///< this and `help` are set by the list of commands (program/commands.cpp)
  std::string help{};    ///< one line
  std::string footer{};  ///< an example, and what else to know
  std::vector<Argument> arguments{};
  std::function<int()> run{};  ///< after parsing; returns the exit status

  void add(Argument argument) { arguments.push_back(std::move(argument)); }
  void add(Arguments rows) {
    for (Argument& row : rows) add(std::move(row));
  }
  /// A text as it is; it stays empty where none is given.
  void add_text(const std::string& option, std::string& text, const std::string& type, const std::string& words,
                const std::string& group = "") {
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

// The commands, each made where its subject is.

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

}  // namespace clatter::validation
