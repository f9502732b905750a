// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/sink.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/impact_rows.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/run/states.hpp"
#include "validation/sequence/sequence_picture.hpp"
#include "validation/sequence/sequence_report.hpp"

namespace clatter::validation {
namespace {

struct SequenceInput {
  SceneFlags scene;
  std::string method;
  OutputChoice output;
  PlotChoice plot;
  std::optional<TimeWindow> window;
  bool states = false;
};

/// @throws BadInput if the window holds none of the sequence's times.
Picture picture_of(const PreparedScene& prepared, const DiscreteRun& found, const TimeWindow& window) {
  const Picture picture = sequence_picture(prepared, found, window);
  if (picture.panels.front().rows.size() < 2)
    throw BadInput("--window {}: must hold times of the sequence", window.text());
  return picture;
}

/// As write_report() writes a sequence's report, but row by row: a terminal's colours alone need the whole text.
void write_rows_of(const PreparedScene& prepared, const DiscreteRun& found, const analytic::space::TiltEffort& tilts,
                   const OutputChoice& choice) {
  if (choice.style.format == Format::table && choice.path.empty() && is_lively(STDOUT_FILENO))
    return write_report(choice, sequence_report(prepared, found, tilts));
  Sink sink(choice.path);
  write_sequence(prepared, found, tilts, choice.style, [&](std::string_view text) { sink.write(text); });
  sink.commit();
}

int run_sequence(const SequenceInput& input) {
  const PreparedScene prepared = read_discrete_flags(input.scene);
  const OutputChoice& choice = input.output;
  if (input.window && input.plot.path.empty()) throw BadInput("--window {}: needs --plot FILE", input.window->text());
  require_states(input.states, prepared.scene);
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  const DiscreteRun found = run_discrete(prepared);
  for (const std::string& warning : found.run.warnings) say(warning);
  std::optional<Picture> picture;
  if (plot.is_wanted()) picture = picture_of(prepared, found, input.window.value_or(TimeWindow{}));
  // A table's one line on small tilts does not wait for edges that rattle on; JSON lists every outcome.
  analytic::space::TiltEffort tilts;
  if (choice.style.format != Format::json) tilts.rubs = 20;
  if (input.states) write_report(choice, with_states_alone(sequence_report(prepared, found, tilts)));
  else write_rows_of(prepared, found, tilts, choice);
  if (picture)
    plot.write(*picture, run_words("sequence", "impact sequence, discrete model", prepared.scene, Model::discrete));
  return status_of(shortfall(prepared.scene, found.run), shortfall_status(found.run));
}

}  // namespace

Command sequence_command() {
  return command_of<SequenceInput>(run_sequence, [](Command& command, SequenceInput& input) {
    add_scene_flags(command, input.scene, Model::discrete);
    add_time_flags(command, input.scene);
    command.add(read_argument("--method", input.method, read_sequence_method, "NAME",
                              "auto or discrete, the same (auto)", "Scene"));
    add_output_options(command, input.output);
    command.add(choice_argument("--rows", input.states, {"impacts", "states"},
                                "of CSV: at the times asked for (impacts)", "Output"));
    add_plot_options(command, input.plot);
    add_window_option(command, input.window, "of the picture");
    command.footer = "Example: clatter sequence --angle 10 --gravity 9.81 --restitution 0.8 --impacts 20";
    command.columns = {{"sequence", [] { return with_more(sequence_columns(), impact_columns(RunModel::space, {})); }},
                       {"states", state_columns}};
  });
}

}  // namespace clatter::validation
