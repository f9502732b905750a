// Shell completion and the man page, both generated from the parser.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <sstream>

#include "validation/cli/commands.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string long_name(const CLI::Option& option) {
  return option.get_lnames().empty() ? "" : "--" + option.get_lnames()[0];
}

/// "a|b|c" as a list, where an option's type is such a choice.
std::vector<std::string> choices(const CLI::Option& option) {
  std::vector<std::string> list;
  const std::string type = option.get_type_name();
  if (type.find('|') == std::string::npos) return list;
  std::istringstream stream(type);
  for (std::string word; std::getline(stream, word, '|');) list.push_back(word);
  return list;
}

bool is_file(const CLI::Option& option) { return option.get_type_name() == "FILE"; }

/// Options of any command that take a file, each once.
std::vector<std::string> file_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) {
    for (const CLI::Option* option : command->get_options()) {
      const std::string name = long_name(*option);
      if (name.empty() || !is_file(*option) || std::find(names.begin(), names.end(), name) != names.end()) continue;
      names.push_back(name);
    }
  }
  return names;
}

std::string words(const CLI::App& command) {
  std::string all;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = long_name(*option);
    if (!name.empty()) all += (all.empty() ? "" : " ") + name;
  }
  return all;
}

std::string command_words(const CLI::App& app) {
  std::string all;
  for (const CLI::App* command : commands_of(app)) all += (all.empty() ? "" : " ") + command->get_name();
  return all;
}

std::string bash_completion(const CLI::App& app) {
  std::string out =
      "# bash completion for clatter\n_clatter() {\n"
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\" previous=\"${COMP_WORDS[COMP_CWORD-1]}\" list=\"\"\n"
      "  case \"$previous\" in\n";
  std::vector<std::string> done;
  for (const CLI::App* command : commands_of(app)) {
    for (const CLI::Option* option : command->get_options()) {
      const auto list = choices(*option);
      const std::string name = long_name(*option);
      if (list.empty() || name.empty() || std::find(done.begin(), done.end(), name) != done.end()) continue;
      done.push_back(name);
      out += fmt::format("    {}) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n", name,
                         fmt::join(list, " "));
    }
  }
  out += fmt::format("    {}) COMPREPLY=($(compgen -f -- \"$word\")); return ;;\n  esac\n",
                     fmt::join(file_options(app), "|"));
  out += fmt::format("  if ((COMP_CWORD == 1)); then list=\"{} --help --version\"; else\n"
                     "    case \"${{COMP_WORDS[1]}}\" in\n", command_words(app));
  for (const CLI::App* command : commands_of(app)) {
    const std::string extra = command->get_name() == "completion" ? " bash zsh fish" : "";
    out += fmt::format("      {}) list=\"{}{}\" ;;\n", command->get_name(), words(*command), extra);
  }
  return out + "    esac\n  fi\n  COMPREPLY=($(compgen -W \"$list\" -- \"$word\"))\n}\n"
               "complete -F _clatter clatter\n";
}

/// Text inside single quotes of a shell, without what zsh's specs give a meaning.
std::string plain(std::string text) {
  std::erase_if(text, [](char c) { return c == '\'' || c == '[' || c == ']' || c == ':'; });
  return text;
}

std::string zsh_completion(const CLI::App& app) {
  std::string out = "#compdef clatter\n_clatter() {\n  local -a commands\n  commands=(\n";
  for (const CLI::App* command : commands_of(app)) {
    out += fmt::format("    '{}:{}'\n", command->get_name(), plain(command->get_description()));
  }
  out += "  )\n  if ((CURRENT == 2)); then _describe command commands; return; fi\n"
         "  case $words[2] in\n";
  for (const CLI::App* command : commands_of(app)) {
    out += fmt::format("    {}) _arguments", command->get_name());
    for (const CLI::Option* option : command->get_options()) {
      const std::string name = long_name(*option);
      if (name.empty()) continue;
      const auto list = choices(*option);
      const std::string value = option->get_items_expected_max() == 0 ? ""
                                : list.empty() ? (is_file(*option) ? ":file:_files" : ":value: ")
                                               : fmt::format(":value:({})", fmt::join(list, " "));
      out += fmt::format(" \\\n      '{}[{}]{}'", name, plain(option->get_description()), value);
    }
    out += " ;;\n";
  }
  return out + "  esac\n}\n_clatter \"$@\"\n";
}

std::string fish_completion(const CLI::App& app) {
  std::string out = "# fish completion for clatter\n";
  for (const CLI::App* command : commands_of(app)) {
    out += fmt::format("complete -c clatter -f -n __fish_use_subcommand -a {} -d '{}'\n",
                       command->get_name(), plain(command->get_description()));
    for (const CLI::Option* option : command->get_options()) {
      const std::string name = long_name(*option);
      if (name.empty()) continue;
      const auto list = choices(*option);
      const std::string value = option->get_items_expected_max() == 0 ? ""
                                : list.empty() ? (is_file(*option) ? " -r -F" : " -x")
                                               : fmt::format(" -x -a '{}'", fmt::join(list, " "));
      out += fmt::format("complete -c clatter -n '__fish_seen_subcommand_from {}' -l {}{} -d '{}'\n",
                         command->get_name(), name.substr(2), value, plain(option->get_description()));
    }
  }
  return out;
}

std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '-') out += "\\-";
    else if (c == '\\') out += "\\e";
    else out += c;
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string man_options(const CLI::App& command) {
  std::string out;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = long_name(*option);
    const std::string value = option->get_items_expected_max() == 0 ? "" : " \\fI" + roff(option->get_type_name()) + "\\fR";
    out += ".TP\n\\fB" + roff(name.empty() ? option->get_name() : name) + "\\fR" + value + "\n" +
           roff(option->get_description()) + "\n";
  }
  return out;
}

std::string man_page(const CLI::App& app) {
  std::string out = fmt::format(
      ".TH CLATTER 1 \"\" \"clatter {}\" \"User Commands\"\n.SH NAME\nclatter \\- {}\n.SH SYNOPSIS\n"
      ".B clatter\n.I command\n[\\fIoptions\\fR]\n.SH DESCRIPTION\n"
      "Impact sequences of a rod or box that falls on the ground at an angle.  Data go to standard "
      "output, messages to standard error.\n.SH COMMANDS\n", version, roff(app.get_description()));
  for (const CLI::App* command : commands_of(app)) {
    out += ".SS " + command->get_name() + "\n" + roff(command->get_description()) + "\n" +
           man_options(*command) + ".PP\n" + roff(command->get_footer()) + "\n";
  }
  return out +
         ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\na check failed\n.TP\n2\nbad input\n.TP\n3\n"
         "a number could not be computed\n.TP\n4\noutside the model's range, such as jamming\n.TP\n130\n"
         "interrupted\n.SH ENVIRONMENT\n.TP\nNO_COLOR, TERM\nno progress is shown with NO_COLOR set or "
         "TERM=dumb, nor off a terminal\n";
}

int print(const std::string& text) {
  Sink sink("");
  sink.write(text);
  sink.commit();
  return 0;
}

}  // namespace

Action add_completion_command(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("completion", "print the completion script of a shell");
  command->add_option("SHELL", *shell, "bash, zsh or fish")->type_name("")->required();
  command->footer("Example: clatter completion bash > ~/.local/share/bash-completion/completions/clatter");
  return [shell, &app] {
    switch (read_name_option("completion", *shell, {"bash", "zsh", "fish"})) {
      case 0: return print(bash_completion(app));
      case 1: return print(zsh_completion(app));
      default: return print(fish_completion(app));
    }
  };
}

Action add_man_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("man", "print the manual page (roff)");
  command->footer("Example: clatter man | man -l -");
  return [&app] { return print(man_page(app)); };
}

}  // namespace clatter::validation
