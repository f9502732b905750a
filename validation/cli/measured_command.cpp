// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter measured fit|predict|score FILE`: impact laws against tracked drops.
#include <fmt/format.h>

#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/measured_run.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/plot_options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/reports/measured_report.hpp"

namespace clatter::validation::inline cli {
namespace {

const std::vector<std::string>& actions() {
  static const std::vector<std::string> names{"fit", "predict", "score"};
  return names;
}

enum class Action { fit, predict, score };

struct MeasuredInput {
  std::string action;
  MeasuredRequest request;
  std::optional<std::string> drop;
  OutputTexts output;
  PlotTexts plot;
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
  const OutputChoice choice = read_output(input.output);
  check_files(choice, plot_files(input.plot));
  if (action == Action::fit && (input.plot.plot || input.drop))
    throw BadInput("--plot: predict and score draw a picture, fit does not");
  if (input.drop && !input.plot.plot) throw BadInput(fmt::format("--drop {}: needs --plot FILE", *input.drop));
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
               .target = &input->request.file,
               .type = "FILE",
               .help = "poses, frame by frame (CSV), or square-drops or cube-tosses, which come with the program",
               .required = true});
  command.add_text("--body", input->request.body, "FILE",
                   "what was tracked: a TOML file, square-drops or cube-tosses (the file's own name with .toml)");
  command.add_text("--seed", input->request.seed, "N", "draws the drops to fit on (1)");
  command.add_text("--share", input->request.share, "X", "of the drops to fit on (0.5)");
  command.add_text("--fit-on", input->request.fit_on, "LIST", "fit on these drops, as in 1,3,10-20; score the others");
  command.add_text("--fit-from", input->request.fit_from, "FILE", "fit on another file's drops, score all of this one");
  command.add_text("--drop", input->drop, "NAME", "to draw (the first point impact)");
  add_output_options(command, input->output);
  add_plot_options(command, input->plot);
  command.footer =
      "Example: clatter measured score square-drops --plot score.svg\n"
      "No drop is both fitted to and scored.";
  command.run = [input] { return run_measured(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
