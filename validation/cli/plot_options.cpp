// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/plot_options.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "validation/cli/options.hpp"
#include "validation/figures/gnuplot.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/symbols.hpp"
#include "validation/scene/scene_value.hpp"

namespace clatter::validation::inline cli {
namespace {

using std::filesystem::path;

const char* const script_option = "--plot-script";

PictureFormat format_of(const std::string& file) {
  const std::string extension = path(file).extension().string();
  if (extension == ".svg") return PictureFormat::svg;
  if (extension == ".png") return PictureFormat::png;
  throw BadInput(fmt::format("--plot {}: the name must end in .svg or .png", file));
}

}  // namespace

void add_plot_options(Command& command, PlotTexts& texts) {
  command.add_text("--plot", texts.plot, "FILE", "also a picture, .svg or .png (needs gnuplot)", "Output");
  command.add_flag(script_option, texts.script, "and beside it the gnuplot script that draws it", "Output");
}

std::vector<std::string> run_words(const std::string& command, const std::string& what, const Scene& scene,
                                   Model model) {
  return {headline(command, what), scene_line(scene, model)};
}

void add_window_option(Command& command, std::optional<std::string>& text, const std::string& of) {
  command.add_text("--window", text, "FROM:TO", "times " + of + ", in s after the first touch-down", "Output");
}

std::vector<RunFile> plot_files(const PlotTexts& texts) {
  if (!texts.plot) {
    if (texts.script)
      throw BadInput(fmt::format("{}: needs --plot FILE, beside which the script is kept", script_option));
    return {};
  }
  std::vector<RunFile> files{{"--plot", *texts.plot}};
  if (texts.script) files.push_back({script_option, path(*texts.plot).replace_extension(".gnuplot").string()});
  return files;
}

PlotFile::PlotFile(const PlotTexts& texts) {
  const std::vector<RunFile> files = plot_files(texts);
  if (files.empty()) return;
  path_ = files[0].path;
  format_ = format_of(path_);
  if (texts.script) script_path_ = files[1].path;
  picture_.emplace(path_, "--plot");
  if (texts.script) script_.emplace(script_path_, script_option);
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

}  // namespace clatter::validation::inline cli
