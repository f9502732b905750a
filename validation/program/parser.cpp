// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/program/program.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <sstream>

#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/report.hpp"
#include "validation/output/version.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

constexpr const char* scene_help = "scene";

/// What stands before a command: the program's own options.
const Command& program_options() {
  static bool version = false;  // the parser has the target that counts
  static const Command options = [] {
    Command program;
    program.add_flag("--version", version, "");
    return program;
  }();
  return options;
}

/// The words after the program's name as they are said today: a form by its command and the word that asks for it.
std::vector<std::string> words_of_today(const std::vector<Command>& commands, std::vector<std::string> given,
                                        std::string& note) {
  const std::size_t place = given.front() == "help" && given.size() > 1 ? 1 : 0;
  for (const Command& command : commands) {
    if (command.was.empty() || command.was != given[place]) continue;
    if (place == 1 && command.first_word() == "help") break;  // "help keys" is the new name
    note = fmt::format("{}: is {} now; the old name goes with the next version", command.was, command.name);
    given[place] = command.first_word();
    given.insert(given.begin() + static_cast<std::ptrdiff_t>(place) + 1, command.form());
    break;
  }
  return given;
}

/// `help NAME` is NAME --help, but for what has a page of its own, such as `help keys`.
std::vector<std::string> with_help_as_flag(const std::vector<Command>& commands, std::vector<std::string> given) {
  if (given.front() != "help") return given;
  const auto is_page = [&](const Command& command) {
    return command.first_word() == "help" && given.size() > 1 && command.form() == given[1];
  };
  if (std::any_of(commands.begin(), commands.end(), is_page)) return given;
  given.erase(given.begin());
  if (given.empty() || given.back() != "--help") given.emplace_back("--help");
  return given;
}

/// The command that the words call, or the form of it that one of them asks for, which is taken out with the name.
/// @throws BadInput for a name that none has
const Command& called_command(const std::vector<Command>& commands, std::vector<std::string>& words) {
  const Command* called = nullptr;
  auto asking = words.begin();
  std::vector<std::string> known{scene_help}, meant{std::string("help ") + scene_help};
  for (const Command& command : commands) {
    known.push_back(command.was.empty() ? command.name : command.was);
    meant.push_back(command.name);
    if (command.first_word() != words.front()) continue;
    const auto found = std::find(words.begin() + 1, words.end(), command.form());
    if (command.form().empty()) called = called == nullptr ? &command : called;
    else if (found != words.end()) called = &command, asking = found;
  }
  if (called == nullptr) {
    const std::optional<std::string> near = near_name(words.front(), known);
    const std::ptrdiff_t place = near ? std::find(known.begin(), known.end(), *near) - known.begin() : 0;
    throw BadInput(
        "command '{}': unknown; {}", words.front(),
        near ? fmt::format("did you mean {}?", meant[static_cast<std::size_t>(place)]) : "clatter help lists them");
  }
  if (asking != words.begin()) words.erase(asking);
  words.erase(words.begin());
  return *called;
}

/// A flag of scenes where scenes are varied by their keys instead.
/// @throws BadInput saying how
void require_scene_by_keys(const Command& command, const std::string& name) {
  const std::vector<std::string> names = command.option_names();
  if (std::find(names.begin(), names.end(), "--set") == names.end()) return;
  for (const Key& key : all_keys()) {
    if (key.flag != name) continue;
    throw BadInput("{}: {} takes a scene and its keys, as in clatter {} rod-10 --set {}=...", name, command.name,
                   command.name, key.name);
  }
}

/// The argument of that name; none for --help, which every command has.
const Argument* find_option(const Command& command, const std::string& name) {
  if (name == "--help") return nullptr;
  for (const Argument& argument : command.arguments) {
    if (argument.name == name && argument.is_option()) return &argument;
  }
  if (command.name.empty() && name == "--mpi") {
    throw BadInput(
        "--mpi: is of ./clatter in the sources, which builds clatter-mpi; installed beside clatter, mpirun -n N "
        "clatter "
        "takes it");
  }
  const auto is_flag_of_scenes = [&](const Key& key) { return key.flag == name; };
  if (command.name.empty() && std::any_of(all_keys().begin(), all_keys().end(), is_flag_of_scenes))
    throw BadInput("{}: a command comes first; did you mean clatter sequence {}?", name, name);
  static const std::set<std::string> of_simulator{"--tolerance", "--step", "--history", "--planar"};
  if (command.name == "sequence" && of_simulator.contains(name))
    throw BadInput("{}: is the simulator's; the discrete model has no such option", name);
  require_scene_by_keys(command, name);
  if (command.name == "angles" && name == "--angle")
    throw BadInput("--angle: angles takes a range of them, --from, --to and --step");
  if (command.name == "angles" && (name == "--height" || name == "--clearance"))
    throw BadInput(name + ": angles takes the speed at the touch, --gravity G --speed V with V = sqrt(2 G (fall))");
  if (name == "--gravity-number")
    throw BadInput("--gravity-number: is of angles; {} takes --gravity in m/s^2, the number times v_n^2/L",
                   command.name);
  if (command.name == "report" && name == "--filter")
    throw BadInput("--filter: is of shock; report judges unfiltered peaks, beside which filtered ones are too mild");
  if (name == "--probe" || name == "--part")
    throw BadInput("{}: is for shock, sweep and report; leave it out of {}", name, command.name);
  const std::vector<std::string> known = command.option_names();
  static const std::set<std::string> heights{"--drop", "--from", "--fall", "--drop-height", "--fall-height"};
  const bool is_height = heights.contains(name) && std::ranges::count(known, "--clearance") > 0;
  // As heads of tables and texts have them.
  static const std::map<std::string, std::string> symbols{
      {"--e", "--restitution"}, {"--mu", "--friction"}, {"--g", "--gravity"}, {"--k", "--stiffness"}};
  const auto symbol = symbols.find(name);
  if (symbol != symbols.end() && std::ranges::count(known, symbol->second) > 0)
    throw BadInput("option {}: unknown for {}; did you mean {}?", name, command.name, symbol->second);
  throw BadInput("option {}: unknown{}{}", name, command.name.empty() ? "" : " for " + command.name,
                 is_height ? "; did you mean --clearance, of the lowest point, or --height, of the centre of mass?"
                           : suggestion(name, known));
}

/// Takes one command's arguments apart.
class Scan {
 public:
  Scan(const Command& command, std::vector<std::string>& out) : command_(command), out_(out) {}

  void option(const std::string& argument, const std::string* next, bool& used_next) {
    const std::size_t equal = argument.find('=');
    const std::string name = argument.substr(0, equal);
    const Argument* option = find_option(command_, name);
    const bool may_repeat = option && option->repeats;
    if (!seen_.insert(name).second && !may_repeat) throw BadInput("{}: given twice", name);
    list_ = option && option->is_list() ? name : "";
    if (!option || option->is_flag()) {
      if (equal != std::string::npos) throw BadInput("{}: takes no value", name);
      out_.push_back(name);
      return;
    }
    used_next = equal == std::string::npos;
    if (used_next && (next == nullptr || next->starts_with("--"))) throw BadInput("{}: needs a value", name);
    const std::string value = used_next ? *next : argument.substr(equal + 1);
    if (value.empty()) throw BadInput("{} '': the value is empty", name);
    out_.push_back(name + "=" + value);
  }

  /// A value of the list before it, or an argument of its own.
  void positional(const std::string& argument) {
    if (!list_.empty()) {
      if (argument.empty()) throw BadInput("{} '': the value is empty", list_);
      out_.push_back(list_ + "=" + argument);
      return;
    }
    std::size_t allowed = 0;
    bool takes_many = false;
    for (const Argument& one : command_.arguments) {
      allowed += one.is_option() ? 0 : 1;
      takes_many = takes_many || (!one.is_option() && one.is_list());
    }
    if (++positionals_ > allowed && !takes_many)
      throw BadInput("'{}': unexpected argument for {}", argument, command_.name);
    out_.push_back(argument);
  }

 private:
  const Command& command_;
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

/// Checks the words after a command's name and joins each option with its value as "--name=value", so that a value may
/// begin with a minus sign.
/// @throws BadInput with one line.
std::vector<std::string> checked_arguments(const Command& command, const std::vector<std::string>& arguments) {
  std::vector<std::string> out;
  Scan scan(command, out);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    bool used_next = false;
    if (argument == "-h") out.push_back("--help");
    else if (argument.starts_with("--") && argument.size() > 2) {
      scan.option(argument, i + 1 < arguments.size() ? &arguments[i + 1] : nullptr, used_next);
    } else if (is_short_option(argument)) {
      throw BadInput("option {}: unknown; options begin with two dashes", argument);
    } else if (command.name.empty()) {
      throw BadInput("'{}': a command comes before its options", argument);
    } else {
      scan.positional(argument);
    }
    if (used_next) ++i;
  }
  return out;
}

/// Texts of arguments that have a reader, which wait until the whole line is known to be in order.
struct WaitingText {
  const Argument* argument;
  std::string text{};
  const CLI::Option* option = nullptr;
};
using Waiting = std::deque<WaitingText>;

CLI::Option* add_value(CLI::App& app, const Argument& argument, Waiting& waiting) {
  if (bool* const* truth = std::get_if<bool*>(&argument.target))
    return app.add_flag(argument.name, **truth, argument.help);
  const auto add = [&](auto& target) { return app.add_option(argument.name, target, argument.help); };
  CLI::Option* option = nullptr;
  if (auto* const* list = std::get_if<std::vector<std::string>*>(&argument.target)) option = add(**list);
  else if (auto* const* text = std::get_if<std::string*>(&argument.target)) option = add(**text);
  else {
    WaitingText& waits = waiting.emplace_back(WaitingText{&argument});
    waits.option = option = add(waits.text);
  }
  option->type_name(argument.type)->required(argument.required);
  return option;
}

bool is_of_scene(const Argument& argument) { return argument.group == scene_group; }

/// The names of the flags of scenes, all that a command's own help has of them.
std::string scene_words(const Command& command) {
  std::string names;
  for (const Argument& argument : command.arguments) {
    if (is_of_scene(argument)) names += (names.empty() ? "" : ", ") + argument.name;
  }
  if (names.empty()) return "";
  return fmt::format(
      "Flags of the scene, alone or each in place of its key in SCENE; clatter help scene explains them: {}\n\n",
      names);
}

/// The flags that ask for other forms of a command, for its help alone: who gives one has called the form.
void add_forms(CLI::App& app, const std::vector<Command>& commands, const Command& called) {
  for (const Command& command : commands) {
    if (!called.form().empty() || command.first_word() != called.name || !command.form().starts_with("--")) continue;
    const std::string words = fmt::format("{}: clatter help {}", command.help, command.name);
    app.add_flag_function(
           command.form(), [](std::int64_t) {}, words)
        ->group("In place of this");
  }
}

/// CLI11 compares each option with all before it, so that only the command that is called gets its own.
void add_arguments(CLI::App& part, const Command& command, Waiting& waiting) {
  const bool explains_scene = command.name == scene_help;
  part.description(command.help);
  part.footer((explains_scene ? "" : scene_words(command)) + command.footer);
  for (const Argument& argument : command.arguments) {
    CLI::Option* option = add_value(part, argument, waiting);
    if (is_of_scene(argument) && !explains_scene) option->group("");
    else if (!argument.group.empty()) option->group(argument.group);
    if (argument.repeats)
      option->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
}

/// What `clatter help scene` explains, as a command of its own that nobody runs.
Command explained_scene() {
  static SceneFlags flags;
  Command command{.name = scene_help, .help = "the scene of a command: a file, a case, or these flags"};
  add_scene_flags(command, flags);
  add_time_flags(command, flags);
  Command discrete;
  add_scene_flags(discrete, flags, Model::discrete);
  for (Argument& argument : discrete.arguments) {
    const auto is_same = [&](const Argument& other) { return other.name == argument.name; };
    if (std::none_of(command.arguments.begin(), command.arguments.end(), is_same)) command.add(std::move(argument));
  }
  command.footer =
      "Times are those of sequence and simulate.  clatter help keys has each flag's key in a file, its unit and what "
      "is "
      "allowed.";
  return command;
}

/// A line of help within the width of a terminal; what explains an option goes on below its explanation.
std::string folded_line(const std::string& line) {
  constexpr std::size_t width = 79;
  if (display_width(line) <= width) return line;
  const std::size_t name = line.find_first_not_of(' ');
  const std::size_t end = name == 0 || name == std::string::npos ? std::string::npos : line.find("  ", name);
  // A line of its own below a long name goes on where it begins.
  if (end == std::string::npos) return wrapped(line, width, "");
  const std::size_t words = line.find_first_not_of(' ', end);
  const std::size_t column = display_width(line.substr(0, words));
  const std::string indent(column, ' ');
  std::istringstream explained(wrapped(line.substr(words), width - column, ""));
  std::string out = line.substr(0, words), part;
  for (bool first = true; std::getline(explained, part); first = false) out += (first ? "" : "\n" + indent) + part;
  return out;
}

/// An example goes on in its next line as a shell reads it; other text of several wide lines is one paragraph.
std::string folded(const std::vector<std::string>& lines) {
  constexpr std::size_t width = 79;
  std::string out;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string text = lines[i];
    if (text.starts_with("Example: ")) {
      out += folded_command(text);
    } else if (text.empty() || text.starts_with(' ')) {
      out += folded_line(text);
    } else {
      const auto goes_on = [&] { return i + 1 < lines.size() && !lines[i + 1].empty() && lines[i + 1][0] != ' '; };
      while (display_width(lines[i]) > width && goes_on() && !lines[i + 1].starts_with("Ex")) text += " " + lines[++i];
      out += wrapped(text, width, "");
    }
    out += "\n";
  }
  return out;
}

std::string help_of(const CLI::App& app, const Command& called) {
  const auto chosen = app.get_subcommands();
  std::string all = chosen.empty() ? app.help() : chosen[0]->help(app.get_name());
  if (!called.form().empty()) {
    const std::string usage = "clatter " + called.first_word();
    all.insert(all.find(usage) + usage.size(), " " + called.form());
  }
  std::istringstream text(all);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() || (!lines.empty() && !lines.back().empty())) lines.push_back(line);
  }
  return folded(lines);
}

/// For who calls the program without knowing more.
std::string short_help(const std::vector<Command>& commands) {
  std::string names;
  for (const Command& command : commands) {
    if (command.form().empty()) names += (names.empty() ? "" : ", ") + command.name;
  }
  return std::string("clatter ") + version + ": " + program_summary +
         "\n\n"
         "  clatter sequence --angle 10        impacts of a rod that falls at 10 degrees\n"
         "  clatter simulate phone-damped      a phone on a yielding floor, with forces\n"
         "  clatter demo phone-corner          a page to play with, in the browser\n\n" +
         wrapped("Commands: " + names) + "\n\nclatter --help says what each does, clatter help COMMAND how.\n";
}

}  // namespace

ParsedLine parse_line(const std::vector<Command>& commands, const std::vector<std::string>& given) {
  if (given.empty()) return {.text = short_help(commands)};
  if (given == std::vector<std::string>{"help", scene_help}) {
    ParsedLine help = parse_line({explained_scene()}, {scene_help, "--help"});
    const std::string name = std::string("clatter ") + scene_help + " ";
    return {.text = help.text.replace(help.text.find(name), name.size(), "clatter COMMAND ")};
  }
  CLI::App app(program_summary, "clatter");
  app.footer(program_notes);
  app.set_help_flag("--help", "print this help and exit");
  bool show_version = false;
  app.add_flag("--version", show_version, "print the version and exit");
  std::string note;
  std::vector<std::string> words = with_help_as_flag(commands, words_of_today(commands, given, note));
  const bool calls = !words.front().starts_with('-');
  const Command& called = calls ? called_command(commands, words) : program_options();
  std::vector<std::string> arguments = checked_arguments(called, words);
  Waiting waiting;
  for (const Command& command : commands) {
    if (!command.form().empty()) continue;
    CLI::App* part = app.add_subcommand(command.name, command.help);
    if (!command.section.empty()) part->group(command.section);
    if (!calls || command.name != called.first_word()) continue;
    add_arguments(*part, called, waiting);
    add_forms(*part, commands, called);
  }
  if (calls) arguments.insert(arguments.begin(), called.first_word());
  std::reverse(arguments.begin(), arguments.end());  // as CLI11's parse(vector) wants them
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    return {.text = help_of(app, called), .note = note};
  } catch (const CLI::ParseError& error) {
    throw BadInput(error.what());
  }
  if (show_version) return {.text = std::string("clatter ") + version + "\n"};
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) throw BadInput("a command is required; clatter --help lists them");
  for (const WaitingText& waits : waiting) {
    for (const std::string& text : waits.option->results())
      std::get<Argument::Reader>(waits.argument->target)(waits.argument->name, text);
  }
  return {.command = &called, .note = note};
}

Command help_command() {
  static std::string name;
  Command command;
  command.add({.name = "NAME", .target = &name, .help = "a command, scene, keys or columns"});
  command.footer = "Example: clatter help shock";
  return command;
}

}  // namespace clatter::validation
