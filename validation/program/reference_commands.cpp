// SPDX-License-Identifier: GPL-3.0-or-later
// What the program says of itself: `clatter help keys` and `clatter init`, the language of scenes and a scene file to
// begin with; `clatter help columns`, every column of CSV and JSON; shell completion and the man page.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/json.hpp"
#include "validation/output/sink.hpp"
#include "validation/output/version.hpp"
#include "validation/program/program.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/option_values.hpp"
#include "validation/scene/orientation.hpp"

namespace clatter::validation {
namespace {

/// A scene of the shape, with what each needs to be run.
Scene begun_scene(BodyScene::Shape shape) {
  Scene scene;
  scene.angle_deg = 10;
  scene.world.gravity = 9.81;
  scene.world.ground.stiffness = 1e9;
  scene.body.shape = shape;
  return scene;
}

/// "required", or the value that a scene file has without the key; empty: none.
std::string default_words(const Key& key) {
  if (key.is_required) return "required";
  if (key.value.kind == KeyValue::Kind::list || key.value.kind == KeyValue::Kind::curve) return "";
  for (std::size_t shape = 0; shape < shape_names().size(); ++shape) {
    const Value value = key.get(bare_scene(static_cast<BodyScene::Shape>(shape)));
    if (!value.text().empty()) return compact_json(value);
  }
  return "";
}

std::string meaning(const Key& key) {
  const std::string unit = *key.unit == '\0' ? "" : fmt::format(" [{}]", key.unit);
  return fmt::format("{}{}; {}", key.help, unit, key.allowed());
}

/// "face", "edge" or "corner".
const char* part_name(int orientation) {
  const std::size_t axes = orientation_name(orientation).size() / 2;
  return axes == 1 ? "face" : axes == 2 ? "edge" : "corner";
}

/// Lines of "7 -x-y" from one orientation to another.
std::string orientation_lines(int first, int last, int in_a_line) {
  std::string text;
  for (int n = first; n <= last; ++n) {
    const bool begins = (n - first) % in_a_line == 0;
    if (begins) text += fmt::format("\n    {:<6}", n == first ? part_name(n) : "");
    text += fmt::format("  {:>2} {}", n, orientation_name(n));
  }
  return text;
}

/// What the numbers of drop.orientation mean, as a table.
std::string orientations_text() {
  return "\nOrientations: which face, edge or corner of a box points down" + orientation_lines(1, 6, 6) +
         orientation_lines(7, 18, 6) + orientation_lines(19, 26, 4) + "\n";
}

void add_orientations(Report& report) {
  report.fields["orientations"] = Value::List{};
  std::string words = "drop.orientation, what points down:";
  for (int n = 1; n <= orientation_count; ++n) {
    report.fields["orientations"].push_back(
        Value::Fields{{"orientation", n}, {"part", part_name(n)}, {"down", orientation_name(n)}});
    words += fmt::format("{} {} {}", n == 1 ? "" : ",", n, orientation_name(n));
  }
  report.notes.push_back(words);
}

/// What the list of keys has no row for: a table that a file may have several of.
const char* const probes_words =
    "Tables [[probe]] of a file, each with name = \"camera\" and place = [0.05, 0.02, 0.009] in m, body frame, are the "
    "points of clatter shock, report and sweep; flag --probe NAME:X,Y,Z.  Its part = \"500:300\" is what the part "
    "there "
    "bears, flag --part NAME:500:300.";

Report keys_report() {
  Report report = begun_report("keys", "the language of scenes");
  for (const auto& [name, meaning] : {std::pair{"key", "in scene files"},
                                      {"flag", "that overrides it"},
                                      {"default", "without the key"},
                                      {"unit", "of the value"},
                                      {"allowed", "values"},
                                      {"meaning", "of the value"}}) {
    report.grid.columns.push_back(word_column(name, name, meaning));
  }
  for (const Key& key : all_keys()) {
    report.grid.rows.push_back({Cell(key.name), Cell(text_or_nothing(key.flag)), Cell(default_words(key)),
                                Cell(key.unit), Cell(key.allowed()), Cell(key.help)});
  }
  report.fields["keys"] = row_objects(report.grid);
  report.fields["cases"] = Value(case_names());
  add_orientations(report);
  report.notes.emplace_back(probes_words);
  return report;
}

/// Two lines a key, since a table of all columns is wider than a terminal.
std::string keys_text() {
  std::string text = headline("keys", "the language of scenes: keys of files, flags of commands") + "\n";
  for (const Key& key : all_keys()) {
    const std::string given = default_words(key);
    text += fmt::format("\n{}{}{}\n", key.name, *key.flag ? fmt::format("  {}", key.flag) : "",
                        given.empty()         ? ""
                        : given == "required" ? "  (required)"
                                              : fmt::format("  ({})", given));
    text += wrapped("    " + meaning(key), 79, "    ") + "\n";
  }
  text += orientations_text();
  text += "\n" + wrapped(probes_words) + "\n";
  text +=
      "\n" + wrapped(fmt::format("Cases that the program carries: {}", fmt::join(case_names(), ", ")), 79, "  ") + "\n";
  return text;
}

/// A value to begin with, for a key that has none by itself.
std::string example(const Key& key) {
  if (!key.value.example.empty()) return key.value.example;
  const std::string_view name = key.name;
  return name == "run.tolerance" || name == "run.step" || name == "body.mesh.weld" ? "1e-6" : "1";
}

/// A scene file with every key: those of the rod are given, the others are comments.
std::string scene_file() {
  const Scene scene = begun_scene(BodyScene::Shape::rod);
  std::vector<const Key*> keys;
  for (const Key& key : all_keys()) keys.push_back(&key);
  const auto line = [&](const Key& key, const std::string& name) {
    const Value value = key.get(scene);
    const std::string setting = fmt::format("{}{} = {}", value.is_nothing() ? "# " : "", name,
                                            value.is_nothing() ? example(key) : compact_json(value));
    const std::string indent = "#   ";
    return fmt::format("{}\n{}{}", setting, indent, wrapped(meaning(key), 75, indent));
  };
  return scene_text("# A scene: clatter simulate FILE, sequence FILE, compare FILE.", keys, line) +
         "\n# Places of the body, from its geometric centre [m], for clatter shock, report and sweep, and what a part\n"
         "# there bears: 500 Hz and 300 g.  Any number of them.\n"
         "# [[probe]]\n#   name = \"camera\"\n#   place = [0.2, 0, 0]\n#   part = \"500:300\"\n";
}

/// A scene that somebody wrote is worth more than the one to begin with.
void require_new(const std::string& path) {
  if (path.empty()) return;
  const Destination destination = destination_of({"--output", path});
  if (!destination.is_stream && destination.mode)
    throw BadInput("{}: is there already; init writes new files alone", path);
}

int run_keys(const OutputChoice& choice) {
  check_files(choice);
  if (choice.style.format == Format::table) write_out(choice, keys_text());
  else write_report(choice, keys_report());
  return 0;
}

struct InitInput {
  std::string file, option;  ///< one of them, or neither
};

int run_init(const InitInput& input) {
  if (!input.file.empty() && !input.option.empty())
    throw BadInput("--output {}: {} is the file", input.option, input.file);
  const OutputChoice choice{.style = {}, .path = input.file + input.option};
  require_new(choice.path);
  check_files(choice);
  write_out(choice, scene_file());
  return 0;
}

}  // namespace

Command keys_command() {
  return command_of<OutputChoice>(run_keys, [](Command& command, OutputChoice& output) {
    add_output_options(command, output);
    command.footer = "Example: clatter help keys --format markdown";
  });
}

Command init_command() {
  return command_of<InitInput>(run_init, [](Command& command, InitInput& input) {
    command.add(
        {.name = "FILE", .target = &input.file, .type = "FILE", .help = "to write, whole or not at all (stdout)"});
    command.add_text("--output", input.option, "FILE", "the same");
    command.footer = "Example: clatter init scene.toml";
  });
}

// `clatter help columns`: every column of CSV and JSON, by command.

namespace {

struct ColumnsInput {
  std::string command;
  OutputChoice output;
};

std::vector<NamedColumns> all_columns() {
  std::vector<NamedColumns> all;
  for (const Command& command : all_commands()) all.insert(all.end(), command.columns.begin(), command.columns.end());
  return all;
}

Report columns_report(const std::string& command) {
  Report report = begun_report("columns", "the columns of CSV, which are the names in JSON");
  report.grid.columns = {word_column("command", "command", "that writes the column"),
                         word_column("column", "column", "its name"), word_column("unit", "unit", "its unit"),
                         word_column("meaning", "meaning", "what its numbers are")};
  for (const NamedColumns& of : all_columns()) {
    if (!command.empty() && command != of.name) continue;
    for (const Column& column : of.columns())
      report.grid.rows.push_back({Cell(of.name), Cell(column.name), Cell(column.unit), Cell(column.meaning)});
  }
  report.notes = {
      "history: of simulate --history.  sweep: one row per scene; with --rows impact the columns of sequence or "
      "simulate.  map: one quantity.  Before them come the swept keys, which clatter help keys explains.  The files of "
      "figures explain theirs.",
      "corners, place, attitude and touches of a sequence are those of a drop in space; in the plane they are left "
      "out."};
  report.fields["columns"] = row_objects(report.grid);
  return report;
}

/// A column a paragraph, under the command that has it.
std::string columns_text(const Report& report) {
  std::string text = report.title + "\n", command;
  for (const Row& row : report.grid.rows) {
    if (shown_text(row[0]) != command) text += fmt::format("\n{}\n", command = shown_text(row[0]));
    const std::string unit = shown_text(row[2]).empty() ? "" : fmt::format(" [{}]", shown_text(row[2]));
    text += wrapped(fmt::format("  {}{}: {}", shown_text(row[1]), unit, shown_text(row[3])), 79, "    ") + "\n";
  }
  for (const std::string& note : report.notes) text += "\n" + wrapped(note) + "\n";
  return text;
}

int run_columns(const ColumnsInput& input) {
  const OutputChoice& choice = input.output;
  check_files(choice);
  const Report report = columns_report(input.command);
  if (choice.style.format == Format::table) write_out(choice, columns_text(report));
  else write_report(choice, report);
  return 0;
}

}  // namespace

Command columns_command() {
  return command_of<ColumnsInput>(run_columns, [](Command& command, ColumnsInput& input) {
    const auto known = [](const std::string& option, const std::string& name) {
      std::vector<std::string> names;
      for (const NamedColumns& of : all_columns()) names.emplace_back(of.name);
      return names[read_name_option(option, name, names)];
    };
    command.add(read_argument("--only", input.command, known, "COMMAND", "the columns of this one alone"));
    add_output_options(command, input.output);
    command.footer = "Example: clatter help columns --only sequence --format markdown";
  });
}

// Shell completion, made from the descriptions of the commands, and the man page, made from their --help.

namespace {

constexpr const char* file_type = "FILE";
const Argument help_option{.name = "--help", .target = static_cast<bool*>(nullptr), .help = "print this help and exit"};

/// The options of a command as shells complete them, --help first.
std::vector<const Argument*> options_of(const Command& command) {
  std::vector<const Argument*> options{&help_option};
  for (const Argument& argument : command.arguments) {
    if (argument.is_option()) options.push_back(&argument);
  }
  return options;
}

/// The commands as shells complete them: the options of a form are among those of its command.
std::vector<Command> completed_commands() {
  std::vector<Command> commands;
  for (const Command& command : all_commands()) {
    if (command.form().empty()) {
      commands.push_back(command);
      continue;
    }
    Command& whole = commands.back();
    if (command.form().starts_with("--")) {
      whole.add({.name = command.form(), .target = static_cast<bool*>(nullptr), .help = command.help});
    }
    for (const Argument& argument : command.arguments) {
      const std::vector<std::string> known = whole.option_names();
      if (argument.is_option() && std::find(known.begin(), known.end(), argument.name) == known.end())
        whole.add(argument);
    }
  }
  return commands;
}

std::string command_words() {
  std::string names;
  for (const Command& command : completed_commands()) names += (names.empty() ? "" : " ") + command.name;
  return names;
}

/// What may stand after the command's name, as far as it is known.
std::string words_after(const Command& command) {
  if (command.name == "help") return command_words() + " scene keys columns";
  return command.name == "completion" ? "bash zsh fish" : "";
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

std::string bash_completion() {
  std::string out =
      "# bash completion for clatter\n_clatter() {\n"
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\" previous=\"${COMP_WORDS[COMP_CWORD-1]}\" list=\"\"\n"
      "  case \"$previous\" in\n";
  std::vector<std::string> done;
  const std::vector<Command> commands = completed_commands();
  for (const Command& command : commands) {
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
  for (const Command& command : commands) {
    out += fmt::format("      {}) list=\"{} {}\" ;;\n", command.name, fmt::join(command.option_names(), " "),
                       words_after(command));
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
  const std::vector<Command> commands = completed_commands();
  std::string out = "#compdef clatter\n_clatter() {\n  local -a commands\n  commands=(\n";
  for (const Command& command : commands) out += fmt::format("    '{}:{}'\n", command.name, plain(command.help));
  out +=
      "  )\n  if ((CURRENT == 2)); then _describe command commands; return; fi\n"
      "  case $words[2] in\n";
  for (const Command& command : commands) {
    out += fmt::format("    {}) _arguments", command.name);
    for (const Argument* option : options_of(command)) {
      const auto list = option->choices();
      const std::string value = option->is_flag() ? ""
                                : list.empty()    ? (option->type == file_type ? ":file:_files" : ":value: ")
                                                  : fmt::format(":value:({})", fmt::join(list, " "));
      out += fmt::format(" \\\n      '{}[{}]{}'", option->name, plain(option->help), value);
    }
    const std::string after = words_after(command);
    out += (after.empty() ? "" : fmt::format(" \\\n      '2:name:({})'", after)) + " ;;\n";
  }
  return out + "  esac\n}\n_clatter \"$@\"\n";
}

std::string fish_completion() {
  std::string out = "# fish completion for clatter\n";
  for (const Command& command : completed_commands()) {
    out += fmt::format("complete -c clatter -f -n __fish_use_subcommand -a {} -d '{}'\n", command.name,
                       plain(command.help));
    const std::string after = words_after(command);
    if (!after.empty())
      out += fmt::format("complete -c clatter -f -n '__fish_seen_subcommand_from {}' -a '{}'\n", command.name, after);
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

/// "clatter sequence [SCENE] [OPTION]...", a command a line.
std::string synopsis() {
  std::string lines;
  for (const Command& command : all_commands()) {
    std::string line = "clatter " + command.name;
    for (const Argument& argument : command.arguments) {
      if (!argument.is_option()) line += argument.required ? " " + argument.name : " [" + argument.name + "]";
    }
    lines += (lines.empty() ? "" : ".br\n") + roff(line + " [OPTION]...");
  }
  return lines;
}

std::string man_page() {
  std::string page = fmt::format(
      ".TH CLATTER 1 \"\" \"clatter {}\" \"User Commands\"\n.SH NAME\nclatter \\- {}\n.SH SYNOPSIS\n{}.SH "
      "DESCRIPTION\n{}",
      version, program_summary, synopsis(), roff(program_notes));
  for (const Command& command : all_commands()) {
    page += ".SH clatter " + command.name + "\n" + roff(command.help);
    for (const Argument& argument : command.arguments)
      page += ".TP\n" + roff(argument.name + " " + argument.type) + roff(argument.help);
    page += ".PP\n" + roff(command.footer);
  }
  return page;
}

int run_completion(const std::string& shell) {
  std::string (*const scripts[])(){bash_completion, zsh_completion, fish_completion};
  write_out({}, scripts[read_name_option("completion", shell, {"bash", "zsh", "fish"})]());
  return 0;
}

}  // namespace

Command completion_command() {
  return command_of<std::string>(run_completion, [](Command& command, std::string& shell) {
    command.add({.name = "SHELL", .target = &shell, .help = "bash, zsh or fish", .required = true});
    command.footer = "Example: clatter completion bash > ~/.local/share/bash-completion/completions/clatter";
  });
}

Command man_command() {
  Command command;
  command.footer = "Example: clatter man | man -l -";
  command.run = [] {
    write_out({}, man_page());
    return 0;
  };
  return command;
}

}  // namespace clatter::validation
