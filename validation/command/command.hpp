// SPDX-License-Identifier: GPL-3.0-or-later
// A command of the program, described as data: parser, help, completion scripts and manual page are made from it.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/scene/argument.hpp"

namespace clatter::validation {

/// The columns of a table that a command writes, under the name that `clatter help columns` has for it.
struct NamedColumns {
  const char* name;
  std::vector<Column> (*columns)();
};

struct Command {
  /// One word, or a command and the word after it that asks for this form of it: "plan --tradeoff", "help keys".  This
  /// and the next three are set by the list of commands (program/commands.cpp).
  std::string name{};
  std::string was{};      ///< a form's name before it was one, which works for one version more; empty: none
  std::string section{};  ///< of --help that has it
  std::string help{};     ///< one line
  std::string footer{};   ///< an example, and what else to know
  std::vector<Argument> arguments{};
  std::vector<NamedColumns> columns{};
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
  [[nodiscard]] std::string first_word() const { return name.substr(0, name.find(' ')); }
  /// The word that asks for this form of the command; empty: it is the command itself.
  [[nodiscard]] std::string form() const { return name.substr(std::min(first_word().size() + 1, name.size())); }
  /// Names of the options, --help first.
  [[nodiscard]] std::vector<std::string> option_names() const {
    std::vector<std::string> names{"--help"};
    for (const Argument& argument : arguments) {
      if (argument.is_option()) names.push_back(argument.name);
    }
    return names;
  }
};

/// A command whose arguments, which `describe` adds, are read into an input of its own, on which it runs.
template <class Input>
[[nodiscard]] Command command_of(int (*run)(const Input&), void (*describe)(Command&, Input&)) {
  const auto input = std::make_shared<Input>();
  Command command;
  describe(command, *input);
  command.run = [input, run] { return run(*input); };
  return command;
}

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
[[nodiscard]] Command help_command();
[[nodiscard]] Command keys_command();
[[nodiscard]] Command columns_command();
[[nodiscard]] Command init_command();
[[nodiscard]] Command demo_command();
[[nodiscard]] Command completion_command();
[[nodiscard]] Command man_command();

}  // namespace clatter::validation
