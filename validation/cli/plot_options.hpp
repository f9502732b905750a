// --plot and --plot-script of the commands that draw what they have computed.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "validation/figures/picture.hpp"
#include "validation/output/json.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation {

struct PlotTexts {
  std::optional<std::string> plot;
  bool script = false;
};
void add_plot_options(CLI::App& command, PlotTexts& texts);

/// A file that the run reads or writes; an empty path: none.
struct RunFile {
  std::string option, path;
};

/// The picture that was asked for, if one was.  Made before the run, it finds everything that could be wrong with it
/// then; written after the run, the files appear whole or not at all.
class PlotFile {
 public:
  /// @param others files that must be others than the picture's and its script's
  /// @throws BadInput naming the option: the extension, a file that cannot be created or is one of `others`, gnuplot
  /// missing.
  PlotFile(const PlotTexts& texts, const std::vector<RunFile>& others);
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
                                                 const Json& scene);

/// @throws BadInput if the two name the same file, however they are spelled; an empty path is none.
void refuse_same_file(const RunFile& file, const RunFile& other);

}  // namespace clatter::validation
