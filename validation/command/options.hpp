// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several commands share: output, scenes and pictures.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/command/command.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/output/sink.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/history_file.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// Where and how to write.
struct OutputChoice {
  TextStyle style;
  std::string path;  ///< empty: stdout
};
void add_output_options(Command& command, OutputChoice& choice);
/// --format alone.
template <class Value>
[[nodiscard]] Argument format_argument(Value& format, const std::string& help, const std::string& group = "") {
  return choice_argument("--format", format, {"table", "csv", "json", "markdown", "latex"}, help, group);
}

/// Makes sure before a run that what it writes, besides --output, is no input and that the output can be written.
/// @throws as note_written and require_writable.
void check_files(const OutputChoice& choice, const std::vector<RunFile>& written = {});

/// Writes a finished text whole, foreign characters printable.
void write_out(const OutputChoice& choice, const std::string& text);

/// Writes the report in the form that was asked for, or leaves it to a Caught<Report>.
void write_report(const OutputChoice& choice, const Report& report);

// A scene file and the flags that override its keys, for the commands that take one.

/// What was typed, by the name of the flag.
struct SceneFlags {
  std::string source;  ///< scene file or case; empty: flags alone
  Model model = Model::continuous;
  std::map<std::string, std::string> texts;  ///< empty: not typed
  std::map<std::string, bool> truths;
};

/// Heading of their flags in help.
inline constexpr const char* scene_group = "Scene (alone, or each in place of its key in SCENE)";

/// Adds the argument SCENE.
void add_scene_argument(Command& command, std::string& source, bool required);
/// Adds SCENE and the flags of the keys that the model has, but for those of times.
void add_scene_flags(Command& command, SceneFlags& flags, Model model = Model::continuous);
/// Adds those, for a command that tells where the body is at them.
void add_time_flags(Command& command, SceneFlags& flags);
/// What was typed, for read_scene().
[[nodiscard]] std::vector<SceneOverride> overrides_of(const SceneFlags& flags);
/// @throws BadInput with one line.
[[nodiscard]] Scene read_scene_flags(const SceneFlags& flags);
/// For `sequence` and `explain`.  @throws as read_discrete_scene
[[nodiscard]] PreparedScene read_discrete_flags(const SceneFlags& flags);
/// Says on stderr that a restitution or friction which was typed is not that of the continuous model, which is to run.
void warn_of_law(const SceneFlags& given, const Scene& scene);
/// Whether the flag ("--history") was typed.
[[nodiscard]] bool is_given(const SceneFlags& flags, const std::string& name);
/// Whether file or flags have a ground: then the scene can be one of the continuous model.
[[nodiscard]] bool names_ground(const SceneFlags& flags);

// --plot and --plot-script of the commands that draw what they have computed.

struct PlotChoice {
  std::string path;  ///< empty: no picture
  bool script = false;
};
void add_plot_options(Command& command, PlotChoice& choice);
/// --window.  @param of what it is the window, in words
void add_window_option(Command& command, std::optional<TimeWindow>& window, const std::string& of);

/// The files of these options, whether wanted or not.  @throws BadInput if the script is wanted without a picture.
[[nodiscard]] std::vector<RunFile> plot_files(const PlotChoice& choice);

/// The picture that was asked for, if one was.  Made before the run, it finds everything that could be wrong with it
/// then; written after the run, the files appear whole or not at all.
class PlotFile {
 public:
  /// @throws BadInput naming the option: the extension, a file that cannot be created, gnuplot missing.
  explicit PlotFile(const PlotChoice& choice);
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

// Progress on stderr.

/// A line on stderr that renews itself, for runs that last; nothing where progress is not shown.
class Progress {
 public:
  void show(const std::string& text);
  /// ", 40 s left" by the pace so far; empty in the first two seconds, in which nothing is known of it.
  [[nodiscard]] std::string time_left(std::size_t done, std::size_t of) const;
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

 private:
  bool shown_ = false;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// "#####......... 5 of 14".
[[nodiscard]] std::string progress_bar(std::size_t done, std::size_t of);

/// "40 s left".
[[nodiscard]] std::string time_left(double seconds);

}  // namespace clatter::validation
