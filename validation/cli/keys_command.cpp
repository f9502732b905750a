// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter keys` and `clatter init`: the language of scenes, and a scene file to begin with.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/symbols.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation::inline cli {
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

std::string value_words(const Json& value) {
  return value.is_number_float() ? shortest(value.get<double>()) : value.dump();
}

/// "required", or the value that a scene file has without the key; empty: none.
std::string default_words(const Key& key) {
  if (key.is_required) return "required";
  if (std::holds_alternative<ListValue>(key.value)) return "";
  for (const auto shape : {BodyScene::Shape::rod, BodyScene::Shape::box, BodyScene::Shape::mesh}) {
    const Json value = key.get(begun_scene(shape));
    if (!value.is_null() && value != Json("")) return value_words(value);
  }
  return "";
}

std::string meaning(const Key& key) {
  const std::string unit = *key.unit == '\0' ? "" : fmt::format(" [{}]", key.unit);
  return fmt::format("{}{}; {}", key.help, unit, key.allowed());
}

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
  return report;
}

/// Two lines a key, since a table of all columns is wider than a terminal.
std::string keys_text(bool ascii) {
  std::string text = headline("keys", "the language of scenes: keys of files, flags of commands") + "\n";
  for (const Key& key : all_keys()) {
    const std::string given = default_words(key);
    text += fmt::format("\n{}{}{}\n", key.name, *key.flag ? fmt::format("  {}", key.flag) : "",
                        given.empty()         ? ""
                        : given == "required" ? "  (required)"
                                              : fmt::format("  ({})", given));
    text += wrapped("    " + meaning(key), 79, "    ") + "\n";
  }
  return ascii ? to_ascii(text) : text;
}

/// A value to begin with, for a key that has none by itself.
std::string example(const Key& key) {
  if (const auto* list = std::get_if<ListValue>(&key.value)) return list->example;
  if (std::holds_alternative<TextValue>(key.value)) return "\"name\"";
  return std::holds_alternative<NumberValue>(key.value) ? "1e-6" : "1";
}

/// A scene file with every key: those of the rod are given, the others are comments.
std::string scene_file() {
  const Scene scene = begun_scene(BodyScene::Shape::rod);
  std::string text =
      "# A scene: clatter simulate FILE, sequence FILE, compare FILE.  clatter keys explains the keys.\n";
  std::string table;
  for (const Key& key : all_keys()) {
    const std::string name = key.name;
    const std::size_t dot = name.find('.');
    if (name.substr(0, dot) != table) {
      table = name.substr(0, dot);
      text += fmt::format("\n[{}]\n", table);
    }
    const Json value = key.get(scene);
    const std::string setting = fmt::format("{}{} = {}", value.is_null() ? "# " : "", name.substr(dot + 1),
                                            value.is_null() ? example(key) : value_words(value));
    text += fmt::format("{:<34} # {}\n", setting, meaning(key));
  }
  return text;
}

/// A scene that somebody wrote is worth more than the one to begin with.
void require_new(const std::string& path) {
  if (path.empty()) return;
  const Destination destination = destination_of({"--output", path});
  if (!destination.is_stream && destination.mode)
    throw BadInput(fmt::format("--output {}: is there already; init writes new files alone", path));
}

int run_keys(const OutputTexts& texts) {
  const OutputChoice choice = read_output(texts);
  check_files(choice);
  if (choice.style.format == Format::table) write_out(choice, keys_text(choice.style.ascii));
  else write_report(choice, keys_report());
  return 0;
}

}  // namespace

Command keys_command() {
  auto output = std::make_shared<OutputTexts>();
  Command command{.name = "keys", .help = "every key of scenes, its flag and default"};
  add_output_options(command, *output);
  command.footer = "Example: clatter keys --format markdown";
  command.run = [output] { return run_keys(*output); };
  return command;
}

Command init_command() {
  auto file = std::make_shared<std::optional<std::string>>();
  Command command{.name = "init", .help = "a commented scene file to begin with"};
  command.add_text("--output", *file, "FILE", "write there, whole or not at all");
  command.footer = "Example: clatter init --output scene.toml";
  command.run = [file] {
    const OutputChoice choice{.style = {}, .path = file->value_or("")};
    require_new(choice.path);
    check_files(choice);
    write_out(choice, scene_file());
    return 0;
  };
  return command;
}

}  // namespace clatter::validation::inline cli
