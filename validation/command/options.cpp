// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/command/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "validation/output/bad_input.hpp"
#include "validation/output/gnuplot.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/symbols.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/probes.hpp"

namespace clatter::validation {

void add_output_options(Command& command, OutputChoice& choice) {
  command.add(format_argument(choice.style.format, "form of the output (table)", "Output"));
  command.add_text("--output", choice.path, "FILE", "write there, whole or not at all; -: stdout", "Output");
  command.add_flag("--ascii", choice.style.ascii, "plain ASCII in tables", "Output");
  command.add_flag("--bare", choice.style.bare, "CSV without comments", "Output");
}

void check_files(const OutputChoice& choice, const std::vector<RunFile>& written) {
  const RunFile output{"--output", choice.path};
  note_written(output);
  for (const RunFile& file : written) note_written(file);
  require_writable(output);  // or a run would end in vain
}

void write_out(const OutputChoice& choice, const std::string& text) {
  const bool ascii = choice.style.ascii && choice.style.format == Format::table;
  const std::string clean = printable(text, Lines::kept);
  Sink sink(choice.path);
  sink.write(ascii ? to_ascii(clean) : clean);
  sink.commit();
}

void write_report(const OutputChoice& choice, const Report& report) {
  if (Caught<Report>::open) return Caught<Report>::open->all.push_back(report);
  const std::string text = report_text(report, choice.style);
  const bool coloured = choice.style.format == Format::table && choice.path.empty() && is_lively(STDOUT_FILENO);
  if (!coloured) return write_out(choice, text);
  Sink sink("");
  sink.write(with_colours(printable(text, Lines::kept)));
  sink.commit();
}

namespace {

/// Keys that a flag overrides.
std::vector<const Key*> flag_keys(Model model) {
  std::vector<const Key*> keys;
  for (const Key& key : all_keys()) {
    if (key.flag[0] != '\0' && key.is_for(model)) keys.push_back(&key);
  }
  return keys;
}

void add_flag_of(const Key& key, Command& command, SceneFlags& given) {
  if (key.is_truth()) command.add_flag(key.flag, given.truths[key.flag], key.help, scene_group);
  else command.add_text(key.flag, given.texts[key.flag], key.value_type(), key.help, scene_group);
}

}  // namespace

// Some commands that read a scene for one model have the flags of the other alone.
std::vector<SceneOverride> overrides_of(const SceneFlags& given) {
  std::vector<SceneOverride> overrides;
  for (const Key* key : flag_keys(given.model)) {
    const std::string flag = key->flag;
    const auto text = given.texts.find(flag);
    const auto truth = given.truths.find(flag);
    if (text != given.texts.end() && !text->second.empty()) overrides.push_back({key->name, flag, text->second});
    if (truth != given.truths.end() && truth->second)
      overrides.push_back({key->name, flag, flag.starts_with("--no-") ? "false" : "true"});
  }
  return overrides;
}

void add_scene_argument(Command& command, std::string& source, bool required) {
  command.add({.name = "SCENE",
               .target = &source,
               .type = "FILE",
               .help = "scene file (TOML), or the name of a case",
               .required = required});
}

void add_scene_flags(Command& command, SceneFlags& given, Model model) {
  given.model = model;
  add_scene_argument(command, given.source, false);
  for (const Key* key : flag_keys(model)) {
    if (!key->is_of_times()) add_flag_of(*key, command, given);
  }
}

void add_time_flags(Command& command, SceneFlags& given) {
  for (const Key* key : flag_keys(given.model)) {
    if (key->is_of_times()) add_flag_of(*key, command, given);
  }
}

Scene read_scene_flags(const SceneFlags& given) {
  const SceneValues values = scene_values(given.source);
  Scene scene = read_scene(values, overrides_of(given), given.model);
  say_doubts(scene, given.model);
  return scene;
}

PreparedScene read_discrete_flags(const SceneFlags& given) {
  PreparedScene prepared = read_discrete_scene(scene_values(given.source), overrides_of(given));
  say_doubts(prepared.scene, Model::discrete);
  return prepared;
}

void warn_of_law(const SceneFlags& given, const Scene& scene) {
  for (const auto& [key, words] : discrete_law_words(scene))
    if (is_given(given, key_named(key).flag)) say("warning: " + words);
}

bool is_given(const SceneFlags& given, const std::string& name) { return !given.texts.at(name).empty(); }

bool names_ground(const SceneFlags& given) {
  const SceneValues values = scene_values(given.source);
  return std::ranges::any_of(ground_keys,
                             [&](const char* key) { return values.has(key) || is_given(given, key_named(key).flag); });
}

namespace {

using std::filesystem::path;

const char* const script_option = "--plot-script";

PictureFormat format_of(const std::string& file) {
  const std::string extension = path(file).extension().string();
  if (extension == ".svg") return PictureFormat::svg;
  if (extension == ".png") return PictureFormat::png;
  throw BadInput("--plot {}: the name must end in .svg or .png", file);
}

}  // namespace

void add_plot_options(Command& command, PlotChoice& choice) {
  command.add_text("--plot", choice.path, "FILE", "also a picture, .svg or .png (needs gnuplot)", "Output");
  command.add_flag(script_option, choice.script, "and beside it the gnuplot script that draws it", "Output");
}

std::vector<std::string> run_words(const std::string& command, const std::string& what, const Scene& scene,
                                   Model model) {
  return {headline(command, what), scene_line(scene, model)};
}

void add_window_option(Command& command, std::optional<TimeWindow>& window, const std::string& of) {
  const std::string help = "times " + of + ", in s after the first touch-down";
  command.add(read_argument("--window", window, read_window, "FROM:TO", help, "Output"));
}

std::vector<RunFile> plot_files(const PlotChoice& choice) {
  if (choice.path.empty()) {
    if (choice.script) throw BadInput("{}: needs --plot FILE, beside which the script is kept", script_option);
    return {};
  }
  std::vector<RunFile> files{{"--plot", choice.path}};
  if (choice.script) files.push_back({script_option, path(choice.path).replace_extension(".gnuplot").string()});
  return files;
}

PlotFile::PlotFile(const PlotChoice& choice) {
  const std::vector<RunFile> files = plot_files(choice);
  if (files.empty()) return;
  path_ = files[0].path;
  format_ = format_of(path_);
  if (choice.script) script_path_ = files[1].path;
  picture_.emplace(path_, "--plot");
  if (choice.script) script_.emplace(script_path_, script_option);
  require_gnuplot("--plot " + path_, terminal_name(format_));
}

void PlotFile::write(const Picture& picture, const std::vector<std::string>& head) {
  if (!picture_) return;
  picture_->write(run_gnuplot(picture_script(picture, format_, "")));
  if (script_) {
    std::string text;
    for (const std::string& line : head) text += "# " + printable(line) + "\n";
    const std::string name = path(path_).filename().string();
    text +=
        fmt::format("# `gnuplot {}` in this folder writes {} again.\n", path(script_path_).filename().string(), name);
    script_->write(text + picture_script(picture, format_, name));
    script_->commit();
  }
  picture_->commit();
}

void PlotFile::leave_out(const std::string& reason) const {
  if (picture_) say(fmt::format("--plot {}: no picture: {}", path_, reason));
}

void Progress::show(const std::string& text) {
  if (!shows_progress()) return;
  shown_ = true;
  std::fputs(fmt::format("\r\033[Kclatter: {}", text).c_str(), stderr);
}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

std::string Progress::time_left(std::size_t done, std::size_t of) const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  if (done == 0 || seconds < 2) return "";
  return ", " + validation::time_left(seconds * static_cast<double>(of - done) / static_cast<double>(done));
}

std::string time_left(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s left", std::ceil(seconds));
  if (seconds < 6000) return fmt::format("{:.0f} min left", std::ceil(seconds / 60));
  return fmt::format("{:.0f} h left", std::ceil(seconds / 3600));
}

std::string progress_bar(std::size_t done, std::size_t of) {
  constexpr std::size_t width = 30;
  const std::size_t filled = of > 0 ? width * std::min(done, of) / of : 0;
  return std::string(filled, '#') + std::string(width - filled, '.') + fmt::format(" {} of {}", done, of);
}

}  // namespace clatter::validation
