// SPDX-License-Identifier: GPL-3.0-or-later
// Shell completion, made from the descriptions of the commands, and the man page, made from their --help.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <sstream>

#include "validation/cli/commands.hpp"
#include "validation/cli/parser.hpp"
#include "validation/output/sink.hpp"
#include "validation/output/version.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation::inline cli {
namespace {

constexpr const char* file_type = "FILE";
const Argument help_option{
    .name = "--help", .target = static_cast<bool*>(nullptr), .type = "", .help = "print this help and exit"};

/// The options of a command as shells complete them, --help first.
std::vector<const Argument*> options_of(const Command& command) {
  std::vector<const Argument*> options{&help_option};
  for (const Argument& argument : command.arguments) {
    if (argument.is_option()) options.push_back(&argument);
  }
  return options;
}

/// Options of any command that take a file, each once.
std::vector<std::string> file_options() {
  std::vector<std::string> names;
  for (const Command& command : all_commands()) {
    for (const Argument& argument : command.arguments) {
      const bool known = std::find(names.begin(), names.end(), argument.name) != names.end();
      if (argument.is_option() && argument.type == file_type && !known) names.push_back(argument.name);
    }
  }
  return names;
}

std::string command_words() {
  std::vector<std::string> names;
  for (const Command& command : all_commands()) names.push_back(command.name);
  return fmt::format("{}", fmt::join(names, " "));
}

std::string bash_completion() {
  std::string out =
      "# bash completion for clatter\n_clatter() {\n"
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\" previous=\"${COMP_WORDS[COMP_CWORD-1]}\" list=\"\"\n"
      "  case \"$previous\" in\n";
  std::vector<std::string> done;
  for (const Command& command : all_commands()) {
    for (const Argument* option : options_of(command)) {
      const auto list = option->choices();
      if (list.empty() || std::find(done.begin(), done.end(), option->name) != done.end()) continue;
      done.push_back(option->name);
      out += fmt::format("    {}) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n", option->name,
                         fmt::join(list, " "));
    }
  }
  out += fmt::format("    {}) COMPREPLY=($(compgen -f -- \"$word\")); return ;;\n  esac\n",
                     fmt::join(file_options(), "|"));
  out += fmt::format(
      "  if ((COMP_CWORD == 1)); then list=\"{} --help --version\"; else\n"
      "    case \"${{COMP_WORDS[1]}}\" in\n",
      command_words());
  for (const Command& command : all_commands()) {
    const std::string extra = command.name == "completion" ? " bash zsh fish" : "";
    out += fmt::format("      {}) list=\"{}{}\" ;;\n", command.name, fmt::join(command.option_names(), " "), extra);
  }
  return out +
         "    esac\n  fi\n  COMPREPLY=($(compgen -W \"$list\" -- \"$word\"))\n}\n"
         "complete -F _clatter clatter\n";
}

/// Text inside single quotes of a shell, without what zsh's specs give a meaning.
std::string plain(std::string text) {
  std::erase_if(text, [](char c) { return c == '\'' || c == '[' || c == ']' || c == ':'; });
  return text;
}

std::string zsh_completion() {
  std::string out = "#compdef clatter\n_clatter() {\n  local -a commands\n  commands=(\n";
  for (const Command& command : all_commands()) {
    out += fmt::format("    '{}:{}'\n", command.name, plain(command.help));
  }
  out +=
      "  )\n  if ((CURRENT == 2)); then _describe command commands; return; fi\n"
      "  case $words[2] in\n";
  for (const Command& command : all_commands()) {
    out += fmt::format("    {}) _arguments", command.name);
    for (const Argument* option : options_of(command)) {
      const auto list = option->choices();
      const std::string value = option->is_flag() ? ""
                                : list.empty()    ? (option->type == file_type ? ":file:_files" : ":value: ")
                                                  : fmt::format(":value:({})", fmt::join(list, " "));
      out += fmt::format(" \\\n      '{}[{}]{}'", option->name, plain(option->help), value);
    }
    out += " ;;\n";
  }
  return out + "  esac\n}\n_clatter \"$@\"\n";
}

std::string fish_completion() {
  std::string out = "# fish completion for clatter\n";
  for (const Command& command : all_commands()) {
    out += fmt::format("complete -c clatter -f -n __fish_use_subcommand -a {} -d '{}'\n", command.name,
                       plain(command.help));
    for (const Argument* option : options_of(command)) {
      const auto list = option->choices();
      const std::string value = option->is_flag() ? ""
                                : list.empty()    ? (option->type == file_type ? " -r -F" : " -x")
                                                  : fmt::format(" -x -a '{}'", fmt::join(list, " "));
      out += fmt::format("complete -c clatter -n '__fish_seen_subcommand_from {}' -l {}{} -d '{}'\n", command.name,
                         option->name.substr(2), value, plain(option->help));
    }
  }
  return out;
}

/// Text that roff takes as it is, with its breaks of lines.
std::string roff(const std::string& text) {
  std::string out = "\\&";
  for (const char c : text) out += c == '-' ? "\\-" : c == '\\' ? "\\e" : c == '\n' ? "\n.br\n\\&" : std::string(1, c);
  return out + "\n";
}

std::string man_page() {
  std::string page =
      fmt::format(".TH CLATTER 1 \"\" \"clatter {}\" \"User Commands\"\n.SH NAME\nclatter \\- {}\n.SH DESCRIPTION\n{}",
                  version, program_summary, roff(program_notes));
  for (const Command& command : all_commands()) {
    page += ".SH clatter " + command.name + "\n" + roff(command.help);
    for (const Argument& argument : command.arguments) {
      page += ".TP\n" + roff(argument.name + " " + argument.type) + roff(argument.help);
    }
    page += ".PP\n" + roff(command.footer);
  }
  return page;
}

int print(const std::string& text) {
  Sink sink("");
  sink.write(text);
  sink.commit();
  return 0;
}

}  // namespace

Command completion_command() {
  auto shell = std::make_shared<std::string>();
  Command command{.name = "completion", .help = "print the completion script of a shell"};
  command.add({.name = "SHELL", .target = shell.get(), .type = "", .help = "bash, zsh or fish", .required = true});
  command.footer = "Example: clatter completion bash > ~/.local/share/bash-completion/completions/clatter";
  command.run = [shell] {
    switch (read_name_option("completion", *shell, {"bash", "zsh", "fish"})) {
      case 0: return print(bash_completion());
      case 1: return print(zsh_completion());
      default: return print(fish_completion());
    }
  };
  return command;
}

Command man_command() {
  Command command{.name = "man", .help = "print the manual page (roff)"};
  command.footer = "Example: clatter man | man -l -";
  command.run = [] { return print(man_page()); };
  return command;
}

}  // namespace clatter::validation::inline cli
