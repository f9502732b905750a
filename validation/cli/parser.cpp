// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/parser.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "validation/cli/arguments.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/version.hpp"

namespace clatter::validation::inline cli {
namespace {

CLI::Option* add_value(CLI::App& app, const Argument& argument) {
  if (bool* const* truth = std::get_if<bool*>(&argument.target))
    return app.add_flag(argument.name, **truth, argument.help);
  CLI::Option* option =
      std::visit([&](auto* target) { return app.add_option(argument.name, *target, argument.help); }, argument.target);
  option->type_name(argument.type)->required(argument.required);
  return option;
}

void add_command(CLI::App& app, const Command& command) {
  CLI::App* part = app.add_subcommand(command.name, command.help);
  part->footer(command.footer);
  for (const Argument& argument : command.arguments) {
    CLI::Option* option = add_value(*part, argument);
    if (!argument.group.empty()) option->group(argument.group);
    if (argument.repeats) option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
}

/// `help NAME` is NAME --help.
std::vector<std::string> with_help_as_flag(std::vector<std::string> given) {
  if (given.empty() || given.front() != "help") return given;
  given.erase(given.begin());
  given.push_back("--help");
  return given;
}

std::string help_of(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app.help() : chosen[0]->help(app.get_name());
}

}  // namespace

ParsedLine parse_line(const std::vector<Command>& commands, const std::vector<std::string>& given) {
  CLI::App app(program_summary, "clatter");
  app.footer(program_notes);
  app.set_help_flag("--help", "print this help and exit");
  bool show_version = false;
  app.add_flag("--version", show_version, "print the version and exit");
  for (const Command& command : commands) add_command(app, command);
  std::vector<std::string> arguments = checked_arguments(commands, with_help_as_flag(given));
  std::reverse(arguments.begin(), arguments.end());  // as CLI11's parse(vector) wants them
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    return {.text = help_of(app)};
  } catch (const CLI::ParseError& error) {
    throw BadInput(error.what());
  }
  if (show_version) return {.text = std::string("clatter ") + version + "\n"};
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) throw BadInput("a command is required; clatter --help lists them");
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const Command& command) { return command.name == chosen[0]->get_name(); });
  return {.command = &*found};
}

}  // namespace clatter::validation::inline cli
