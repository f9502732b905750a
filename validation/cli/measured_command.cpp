// `clatter measured fit|predict|score FILE`: impact laws against tracked drops.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/plot_options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/reports/measured_report.hpp"

namespace clatter::validation {
namespace {

const std::vector<std::string>& actions() {
  static const std::vector<std::string> names{"fit", "predict", "score"};
  return names;
}

enum class Action { fit, predict, score };

struct MeasuredInput {
  std::string action, file;
  std::optional<std::string> body, seed, share, fit_on, fit_from, drop;
  OutputTexts output;
  PlotTexts plot;
};

bool is_action(const std::string& word) {
  return std::find(actions().begin(), actions().end(), word) != actions().end();
}

/// The words may come in either order.
std::pair<Action, std::string> read_words(const MeasuredInput& input) {
  const bool turned = !is_action(input.action) && is_action(input.file);
  const std::string &action = turned ? input.file : input.action, &file = turned ? input.action : input.file;
  return {static_cast<Action>(read_name_option("ACTION", action, actions())), file};
}

void refuse_two_splits(const MeasuredInput& input) {
  const bool drawn = input.seed || input.share;
  if (input.fit_on && drawn) throw BadInput("--fit-on: excludes --seed and --share; give one of them, not both");
  if (input.fit_from && (drawn || input.fit_on))
    throw BadInput("--fit-from: excludes --seed, --share and --fit-on: all of the file is scored");
}

void refuse_empty(const MeasuredRun& run) {
  if (run.split.fitted.size() < 3 || run.split.scored.empty()) {
    throw BadInput(fmt::format("{}: {} drops to fit on and {} to score: at least 3 and 1 are needed",
                               run.file.file.path, run.split.fitted.size(), run.split.scored.size()));
  }
}

void split_file(const MeasuredInput& input, MeasuredRun& run) {
  const std::size_t count = run.file.file.tracks.size();
  if (input.fit_on) {
    run.split = split_by_list(run.file.file, "--fit-on", *input.fit_on);
    run.split_words = fmt::format("fitted on the {} drops of a list, scored on the other {}", run.split.fitted.size(),
                                  run.split.scored.size());
  } else {
    const int seed = input.seed ? read_integer_option("--seed", *input.seed, 0, 2147483647) : 1;
    const double share =
        input.share ? read_number_option("--share", *input.share, {0, 1, true, "greater than 0, at most 1"}) : 0.5;
    run.split = split_by_seed(count, static_cast<std::uint64_t>(seed), share);
    run.split_words = fmt::format("fitted on {} drops drawn with seed {}, scored on the other {}",
                                  run.split.fitted.size(), seed, run.split.scored.size());
  }
  refuse_empty(run);
  run.fit = fit_measured(run.file, run.split.fitted);
}

TrackPart all_of(const MeasuredFile& file) {
  TrackPart all(file.tracks.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

/// Fits on another file of the same body: all of this one is scored.
void fit_elsewhere(const MeasuredInput& input, const TrackDescription& description, MeasuredRun& run) {
  std::error_code error;
  if (std::filesystem::equivalent(*input.fit_from, run.file.file.path, error))
    throw BadInput(fmt::format("--fit-from {}: the file that is scored; nothing is fitted and scored on the same drops",
                               *input.fit_from));
  const MeasuredFile other = measure_tracks(read_tracks(*input.fit_from, description));
  run.fit = fit_measured(other, all_of(other));
  run.split.scored = all_of(run.file);
  run.split_words = fmt::format("fitted on the {} drops of {}, scored on {}", other.tracks.size(), *input.fit_from,
                                run.split.scored.size());
}

MeasuredRun read_run(const MeasuredInput& input, const std::string& path) {
  refuse_two_splits(input);
  const TrackDescription description = description_of(path, input.body);
  MeasuredRun run{.file = measure_tracks(read_tracks(path, description)), .split = {}, .fit = {}, .split_words = {}};
  if (input.fit_from) fit_elsewhere(input, description, run);
  else split_file(input, run);
  return run;
}

int run_measured(const MeasuredInput& input) {
  const auto [action, path] = read_words(input);
  const OutputChoice choice = read_output(input.output);
  std::vector<RunFile> read{{"the tracks", path}};
  if (input.fit_from) read.push_back({"--fit-from", *input.fit_from});
  check_files(choice, plot_files(input.plot), read);
  if (action == Action::fit && (input.plot.plot || input.drop))
    throw BadInput("--plot: predict and score draw a picture, fit does not");
  PlotFile plot(input.plot);
  const MeasuredRun run = read_run(input, path);
  if (action == Action::fit) {
    write_report(choice, measured_fit_report(run));
    return 0;
  }
  const Scores scores = score_measured(run.file, run.fit, run.split.scored, true);
  std::optional<Picture> picture;
  if (plot.is_wanted()) picture = measured_picture(run, scores, input.drop.value_or(""));
  write_report(choice,
               action == Action::predict ? measured_predict_report(run, scores) : measured_score_report(run, scores));
  if (picture) plot.write(*picture, measured_words(run));
  return 0;
}

}  // namespace

Command measured_command() {
  auto input = std::make_shared<MeasuredInput>();
  Command command{.name = "measured", .help = "impact laws against tracked drops"};
  command.add({.name = "ACTION",
               .target = &input->action,
               .type = "fit|predict|score",
               .help = "what to do",
               .required = true});
  command.add({.name = "FILE",
               .target = &input->file,
               .type = "FILE",
               .help = "poses, frame by frame (CSV)",
               .required = true});
  command.add_text("--body", input->body, "FILE",
                   "what was tracked: a TOML file, square-drops or cube-tosses (the file's own name with .toml)");
  command.add_text("--seed", input->seed, "N", "draws the drops to fit on (1)");
  command.add_text("--share", input->share, "X", "of the drops to fit on (0.5)");
  command.add_text("--fit-on", input->fit_on, "LIST", "fit on these drops, as in 1,3,10-20; score the others");
  command.add_text("--fit-from", input->fit_from, "FILE", "fit on another file's drops, score all of this one");
  command.add_text("--drop", input->drop, "NAME", "to draw (the first point impact)");
  add_output_options(command, input->output);
  add_plot_options(command, input->plot);
  command.footer =
      "Example: clatter measured score square_drops.csv --body square-drops --plot score.svg\n"
      "No drop is both fitted to and scored.  validation/measured/square-drops.toml shows what a description holds.";
  command.run = [input] { return run_measured(*input); };
  return command;
}

}  // namespace clatter::validation
