#include "validation/cli/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "validation/scene/bad_input.hpp"

namespace clatter::validation {
namespace {

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return command;
    names.push_back(command->get_name());
  }
  throw BadInput(fmt::format("command '{}': unknown; did you mean {}?", name, nearest_name(name, names)));
}

const CLI::Option& find_option(const CLI::App& command, const std::string& name) {
  const std::vector<std::string> names = option_names(command);
  if (std::find(names.begin(), names.end(), name) != names.end()) return *command.get_option(name);
  static const std::set<std::string> of_simulator{"--tolerance", "--step", "--history"};
  if (command.get_name() == "sequence" && of_simulator.contains(name)) {
    throw BadInput(fmt::format("{}: the discrete model takes no time steps and has no such option", name));
  }
  throw BadInput(fmt::format("option {}: unknown{}; did you mean {}?", name,
                             command.get_name().empty() ? "" : " for " + command.get_name(),
                             nearest_name(name, names)));
}

/// Takes one command's arguments apart.
class Scan {
 public:
  Scan(const CLI::App& command, std::vector<std::string>& out) : command_(command), out_(out) {}

  void option(const std::string& argument, const std::string* next, bool& used_next) {
    const std::size_t equal = argument.find('=');
    const std::string name = argument.substr(0, equal);
    const CLI::Option& option = find_option(command_, name);
    const bool may_repeat = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    if (!seen_.insert(name).second && !may_repeat) throw BadInput(fmt::format("{}: given twice", name));
    list_ = option.get_items_expected_max() > 1 && !may_repeat ? name : "";
    const bool takes_value = option.get_items_expected_max() > 0;
    if (!takes_value) {
      if (equal != std::string::npos) throw BadInput(fmt::format("{}: takes no value", name));
      out_.push_back(name);
      return;
    }
    used_next = equal == std::string::npos;
    if (used_next && (next == nullptr || next->starts_with("--"))) {
      throw BadInput(fmt::format("{}: needs a value", name));
    }
    const std::string value = used_next ? *next : argument.substr(equal + 1);
    if (value.empty()) throw BadInput(fmt::format("{} '': the value is empty", name));
    out_.push_back(name + "=" + value);
  }

  /// A value of the list before it, or an argument of its own.
  void positional(const std::string& argument) {
    if (!list_.empty()) {
      if (argument.empty()) throw BadInput(fmt::format("{} '': the value is empty", list_));
      out_.push_back(list_ + "=" + argument);
      return;
    }
    std::size_t allowed = 0;
    for (const CLI::Option* option : command_.get_options()) allowed += option->get_positional() ? 1 : 0;
    if (++positionals_ > allowed) {
      throw BadInput(fmt::format("'{}': unexpected argument for {}", argument, command_.get_name()));
    }
    out_.push_back(argument);
  }

 private:
  const CLI::App& command_;
  std::vector<std::string>& out_;
  std::set<std::string> seen_;
  std::size_t positionals_ = 0;
  std::string list_;  ///< option whose values may go on; empty: none
};

/// "-5" is a value that stands alone; "-x" is no option of this program.
bool is_short_option(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-' && argument[1] != '-' &&
         std::isalpha(static_cast<unsigned char>(argument[1])) != 0;
}

}  // namespace

std::vector<std::string> checked_arguments(const CLI::App& app,
                                           const std::vector<std::string>& arguments) {
  std::vector<std::string> out;
  if (arguments.empty()) throw BadInput("a command is required; clatter --help lists them");
  const CLI::App* command = &app;
  std::size_t begin = 0;
  if (!arguments[0].starts_with('-')) {
    command = find_command(app, arguments[0]);
    out.push_back(arguments[0]);
    begin = 1;
  }
  Scan scan(*command, out);
  for (std::size_t i = begin; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    bool used_next = false;
    if (argument == "-h") out.push_back("--help");
    else if (argument.starts_with("--") && argument.size() > 2) {
      scan.option(argument, i + 1 < arguments.size() ? &arguments[i + 1] : nullptr, used_next);
    } else if (is_short_option(argument)) {
      throw BadInput(fmt::format("option {}: unknown; options begin with two dashes", argument));
    } else if (command == &app) {
      throw BadInput(fmt::format("'{}': a command comes before its options", argument));
    } else {
      scan.positional(argument);
    }
    if (used_next) ++i;
  }
  return out;
}

}  // namespace clatter::validation
