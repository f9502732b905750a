// SPDX-License-Identifier: GPL-3.0-or-later
// --plot and --plot-script of the commands that draw what they have computed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/cli/command.hpp"
#include "validation/figures/picture.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline cli {

struct PlotTexts {
  std::optional<std::string> plot;
  bool script = false;
};
void add_plot_options(Command& command, PlotTexts& texts);
/// --window.  @param of what it is the window, in words
void add_window_option(Command& command, std::optional<std::string>& text, const std::string& of);

/// The files of these options, whether wanted or not.  @throws BadInput if the script is wanted without a picture.
[[nodiscard]] std::vector<RunFile> plot_files(const PlotTexts& texts);

/// The picture that was asked for, if one was.  Made before the run, it finds everything that could be wrong with it
/// then; written after the run, the files appear whole or not at all.
class PlotFile {
 public:
  /// @throws BadInput naming the option: the extension, a file that cannot be created, gnuplot missing.
  explicit PlotFile(const PlotTexts& texts);
  [[nodiscard]] bool is_wanted() const { return picture_.has_value(); }

  /// @param head of the script: lines without "# " that say what was run.  @throws as run_gnuplot.
  void write(const Picture& picture, const std::vector<std::string>& head);
  /// Says on stderr why there is no picture, if one was asked for.
  void leave_out(const std::string& reason) const;

 private:
  std::string path_, script_path_;
  PictureFormat format_ = PictureFormat::svg;
  std::optional<Sink> picture_, script_;
};

/// Head of a script: version, command, what it computes, and the whole scene.
[[nodiscard]] std::vector<std::string> run_words(const std::string& command, const std::string& what,
                                                 const Scene& scene, Model model = Model::continuous);

}  // namespace clatter::validation::inline cli
