// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter measured fit|predict|score FILE`: impact laws against tracked drops.
#include <fmt/format.h>

#include <filesystem>
#include <numeric>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/measured/measured_report.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation {
namespace {

void refuse_two_splits(const MeasuredRequest& input) {
  const bool drawn = input.seed || input.share;
  if (!input.fit_on.empty() && drawn)
    throw BadInput("--fit-on: excludes --seed and --share; give one of them, not both");
  if (!input.fit_from.empty() && (drawn || !input.fit_on.empty()))
    throw BadInput("--fit-from: excludes --seed, --share and --fit-on: all of the file is scored");
}

void refuse_empty(const MeasuredRun& run) {
  if (run.split.fitted.size() < 3 || run.split.scored.empty()) {
    throw BadInput(fmt::format("{}: {} drops to fit on and {} to score: at least 3 and 1 are needed",
                               run.file.file.path, run.split.fitted.size(), run.split.scored.size()));
  }
}

void split_file(const MeasuredRequest& input, MeasuredRun& run) {
  const std::size_t count = run.file.file.tracks.size();
  if (!input.fit_on.empty()) {
    run.split = split_by_list(run.file.file, "--fit-on", input.fit_on);
    run.split_words = fmt::format("fitted on the {} drops of a list, scored on the other {}", run.split.fitted.size(),
                                  run.split.scored.size());
  } else {
    const int seed = input.seed.value_or(1);
    run.split = split_by_seed(count, static_cast<std::uint64_t>(seed), input.share.value_or(0.5));
    run.split_words = fmt::format("fitted on {} drops drawn with seed {}, scored on the other {}",
                                  run.split.fitted.size(), seed, run.split.scored.size());
  }
  refuse_empty(run);
  run.fit = fit_measured(run.file, run.split.fitted);
}

TrackPart all_of(const MeasuredFile& file) {
  TrackPart all(file.tracks.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

/// Fits on another file of the same body: all of this one is scored.
void fit_elsewhere(const MeasuredRequest& input, const TrackDescription& description, MeasuredRun& run) {
  std::error_code error;
  if (input.fit_from == run.file.file.path || std::filesystem::equivalent(input.fit_from, run.file.file.path, error))
    throw BadInput(fmt::format("--fit-from {}: the file that is scored; nothing is fitted and scored on the same drops",
                               input.fit_from));
  const MeasuredFile other = measure_tracks(read_tracks(input.fit_from, description));
  run.fit = fit_measured(other, all_of(other));
  run.split.scored = all_of(run.file);
  run.split_words = fmt::format("fitted on the {} drops of {}, scored on {}", other.tracks.size(), input.fit_from,
                                run.split.scored.size());
}

const std::vector<std::string>& actions() {
  static const std::vector<std::string> names{"fit", "predict", "score"};
  return names;
}

enum class Action { fit, predict, score };

struct MeasuredInput {
  std::string action;
  MeasuredRequest request;
  std::string drop;
  OutputChoice output;
  PlotChoice plot;
};

bool is_action(const std::string& word) {
  return std::find(actions().begin(), actions().end(), word) != actions().end();
}

/// The words may come in either order.
std::pair<Action, std::string> read_words(const MeasuredInput& input) {
  const std::string& second = input.request.file;
  const bool turned = !is_action(input.action) && is_action(second);
  const std::string &action = turned ? second : input.action, &file = turned ? input.action : second;
  return {static_cast<Action>(read_name_option("ACTION", action, actions())), file};
}

int run_measured(const MeasuredInput& input) {
  const auto [action, path] = read_words(input);
  const OutputChoice& choice = input.output;
  check_files(choice, plot_files(input.plot));
  const bool has_plot = !input.plot.path.empty(), has_drop = !input.drop.empty();
  if (action == Action::fit && (has_plot || has_drop))
    throw BadInput("--plot: predict and score draw a picture, fit does not");
  if (has_drop && !has_plot) throw BadInput(fmt::format("--drop {}: needs --plot FILE", input.drop));
  PlotFile plot(input.plot);
  MeasuredRequest request = input.request;
  request.file = path;
  const MeasuredRun run = read_measured_run(request);
  if (action == Action::fit) {
    write_report(choice, measured_fit_report(run));
    return 0;
  }
  const Scores scores = score_measured(run.file, run.fit, run.split.scored, true);
  std::optional<Picture> picture;
  if (plot.is_wanted()) picture = measured_picture(run, scores, input.drop);
  write_report(choice,
               action == Action::predict ? measured_predict_report(run, scores) : measured_score_report(run, scores));
  if (picture) plot.write(*picture, measured_words(run));
  return 0;
}

}  // namespace

Arguments measured_arguments(MeasuredRequest& request) {
  const auto as_it_is = [](const std::string&, const std::string& text) { return text; };
  return {read_argument("--body", request.body, as_it_is, "FILE",
                        "what was tracked: a TOML file, square-drops or cube-tosses (the file's own name with .toml)"),
          whole_argument("--seed", request.seed, 0, 2147483647, "N", "draws the drops to fit on (1)"),
          number_argument("--share", request.share, {0, 1, true, "greater than 0, at most 1"}, "X",
                          "of the drops to fit on (0.5)"),
          read_argument("--fit-on", request.fit_on, as_it_is, "LIST",
                        "fit on these drops, as in 1,3,10-20; score the others"),
          read_argument("--fit-from", request.fit_from, as_it_is, "FILE",
                        "fit on another file's drops, score all of this one")};
}

MeasuredRun read_measured_run(const MeasuredRequest& input) {
  refuse_two_splits(input);
  const TrackDescription description = description_of(input.file, input.body);
  MeasuredRun run{
      .file = measure_tracks(read_tracks(input.file, description)), .split = {}, .fit = {}, .split_words = {}};
  if (!input.fit_from.empty()) fit_elsewhere(input, description, run);
  else split_file(input, run);
  return run;
}

Command measured_command() {
  return command_of<MeasuredInput>(run_measured, [](Command& command, MeasuredInput& input) {
    command.add({.name = "ACTION",
                 .target = &input.action,
                 .type = "fit|predict|score",
                 .help = "what to do",
                 .required = true});
    command.add({.name = "FILE",
                 .target = &input.request.file,
                 .type = "FILE",
                 .help = "poses, frame by frame (CSV), or square-drops or cube-tosses, which come with the program",
                 .required = true});
    command.add(measured_arguments(input.request));
    command.add_text("--drop", input.drop, "NAME", "to draw (the first point impact)");
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer =
        "Example: clatter measured score square-drops --plot score.svg\n"
        "FILE has a row a frame, drop by drop: drop, sample, x_m, z_m, angle_rad for motion in a plane, drop, "
        "sample, x_m, y_m, z_m, q0, q1, q2, q3 in space.\n"
        "FILE.toml beside it says what was tracked: [body] size, mass; [track] motion, rate and the columns' names; "
        "[world] ground, gravity. The reference's page of this command has each key and an example.\n"
        "No drop is both fitted to and scored; at least 3 drops are fitted to.";
    command.columns = {{"measured-fit", measured_fit_columns},
                       {"measured-predict", measured_predict_columns},
                       {"measured-score", measured_score_columns}};
  });
}

}  // namespace clatter::validation
