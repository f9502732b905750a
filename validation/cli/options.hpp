// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several commands share: output, scenes, pictures, sweeps and the thin rod.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/cli/command.hpp"
#include "validation/figures/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/discrete_scene.hpp"
#include "validation/scene/option_values.hpp"
#include "validation/scene/rod_parameters.hpp"
#include "validation/scene/scene.hpp"
#include "validation/scene/swept_range.hpp"

namespace clatter::validation::inline cli {

/// Texts of the output options.
struct OutputTexts {
  std::optional<std::string> format, output;
  bool ascii = false, bare = false;
};

/// Where and how to write.
struct OutputChoice {
  TextStyle style;
  std::string path;
};

void add_output_options(Command& command, OutputTexts& texts);

[[nodiscard]] OutputChoice read_output(const OutputTexts& texts);

/// Makes sure before a run that what it writes, besides --output, is no input and that the output can be written.
/// @throws as note_written and require_writable.
void check_files(const OutputChoice& choice, const std::vector<RunFile>& written = {});

/// Writes a finished text whole, foreign characters printable.
void write_out(const OutputChoice& choice, const std::string& text);

/// Writes the report in the form that was asked for.
void write_report(const OutputChoice& choice, const Report& report);

void add_sweep_options(Command& command, SweepTexts& texts, const std::string& what);

// A scene file and the flags that override its keys, for the commands that take one.

/// What was typed, by the name of the flag.
struct SceneFlags {
  std::string source;  ///< scene file or case; empty: flags alone
  Model model = Model::continuous;
  std::map<std::string, std::optional<std::string>> texts;
  std::map<std::string, bool> truths;
};

/// Adds the argument SCENE.
void add_scene_argument(Command& command, std::string& source, bool required);
/// Adds SCENE and the flags of the keys that the model has.
void add_scene_flags(Command& command, SceneFlags& flags, Model model = Model::continuous);
/// What was typed, for read_scene().
[[nodiscard]] std::vector<SceneOverride> overrides_of(const SceneFlags& flags);
/// @throws BadInput with one line.
[[nodiscard]] Scene read_scene_flags(const SceneFlags& flags);
/// For `sequence` and `explain`.  @throws as read_discrete_scene
[[nodiscard]] PreparedScene read_discrete_flags(const SceneFlags& flags);
/// Whether the flag ("--history") was typed.
[[nodiscard]] bool is_given(const SceneFlags& flags, const std::string& name);

// --plot and --plot-script of the commands that draw what they have computed.

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

// Options of the commands that deal with the thin rod's contact angles.

void add_rod_options(Command& command, RodTexts& texts);

}  // namespace clatter::validation::inline cli
