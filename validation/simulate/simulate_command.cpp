// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/run/history_file.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/run/states.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/simulate/simulation_report.hpp"

namespace clatter::validation {
namespace {

using numeric::Outcome;
using numeric::Simulation;

struct SimulateInput {
  SceneFlags scene;
  OutputChoice output;
  PlotChoice plot;
  std::optional<TimeWindow> window;
  bool states = false;
};

/// @throws BadInput if the window has nothing to act on.
void check_window(const SimulateInput& input, const Scene& scene) {
  if (!input.window) return;
  const std::string given = "--window " + input.window->text();
  if (scene.sweep) throw BadInput(given + ": left out in a sweep, whose picture has no time");
  if (scene.history.empty() && input.plot.path.empty()) throw BadInput(given + ": needs --plot FILE or --history FILE");
}

constexpr long evaluations_before_progress = 200'000;

PlannedRun run_scene(const Scene& scene, const numeric::Body& body, const CooperativeInterrupt& interrupt,
                     const std::function<void(int, long)>& show, const numeric::HistoryRecorder& history) {
  numeric::Observer observer{.history = history};
  observer.progress = [&](int impacts, long evaluations) {
    if (evaluations >= evaluations_before_progress) show(impacts, evaluations);
    return !interrupt.requested();
  };
  double fall = 0;
  const numeric::MotionState start = scene.start(body, &fall);
  if (history) record_fall(history, body, scene.world, start, fall, 20);
  return run_to_digits(scene, body, observer);
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) say(fmt::format("warning: {}", warning));
}

int status_of(const Scene& scene, const PlannedRun& planned) {
  if (planned.run.outcome == Outcome::interrupted) return interrupted_status;
  return validation::status_of(shortfall(scene, planned));
}

int status_of(const std::vector<SweptRun>& runs) {
  Shortfalls shortfalls;
  for (const SweptRun& swept : runs) shortfalls.add(shortest(swept.value), shortfall(swept.scene, swept.planned));
  return shortfalls.status(static_cast<long long>(runs.size()), "values");
}

/// @throws BadInput if the picture that is wanted has none of the run's times.
void check_times(const Simulation& run, const PictureHistory& history, const std::optional<TimeWindow>& window) {
  if (run.outcome == Outcome::interrupted || run.impacts.empty() || !window) return;
  if (clipped(history.rows(), *window).size() < 2)
    throw BadInput("--window {}: must hold times of the run", window->text());
}

/// The history's picture, unless there is none to draw: a run that ends early, whose status tells so.
void draw(const Scene& scene, const Simulation& run, const PictureHistory& history, const TimeWindow& window,
          PlotFile& plot) {
  if (run.outcome == Outcome::interrupted) plot.leave_out("interrupted");
  else if (run.impacts.empty()) plot.leave_out("no impact was computed");
  else if (plot.is_wanted())
    plot.write(simulation_picture(scene, history, window),
               run_words("simulate", "impact sequence, continuous contact", scene));
}

int run_single(const Scene& scene, const numeric::Body& body, const SimulateInput& input, PlotFile& plot) {
  const TimeWindow window = input.window.value_or(TimeWindow{});
  const CooperativeInterrupt interrupt;
  std::optional<HistoryFile> history;
  if (!scene.history.empty()) {
    history.emplace(scene.history,
                    std::vector<std::string>{headline("simulate", "time history"), scene_line(scene),
                                             "body: " + compact_json(body_value(scene))},
                    window);
  }
  PictureHistory picture(body);
  numeric::HistoryRecorder recorder;
  if (history || plot.is_wanted()) {
    recorder = [&](const numeric::HistorySample& sample) {
      if (history) history->write(sample);
      if (plot.is_wanted()) picture.add(sample);
    };
  }
  PlannedRun planned;
  {
    Progress progress;
    const auto show = [&](int impacts, long evaluations) {
      progress.show(fmt::format(
          "{} force evaluations, {}", evaluations,
          progress_bar(static_cast<std::size_t>(impacts), static_cast<std::size_t>(scene.request.impacts))));
    };
    planned = run_scene(scene, body, interrupt, show, recorder);
  }
  if (plot.is_wanted()) check_times(planned.run, picture, input.window);
  if (history) history->commit();
  Report report = simulation_report(scene, planned);
  write_report(input.output, input.states ? with_states_alone(std::move(report)) : report);
  draw(scene, planned.run, picture, window, plot);
  warn(planned.warnings);
  return status_of(scene, planned);
}

int run_sweep(const Scene& scene, const numeric::Body& body, const OutputChoice& choice, PlotFile& plot) {
  const CooperativeInterrupt interrupt;
  const std::vector<double> values = scene.sweep->values();
  std::vector<SweptRun> runs;
  std::vector<std::string> warnings;  // each once
  {
    Progress progress;
    for (const double value : values) {
      if (interrupt.requested()) break;
      if (runs.size() % 10 == 0) progress.show(progress_bar(runs.size(), values.size()));
      SweptRun swept{value, scene.at(value), {}};
      swept.planned = run_scene(
          swept.scene, body, interrupt, [](int, long) {}, nullptr);
      for (const std::string& one : swept.planned.warnings) {
        if (std::find(warnings.begin(), warnings.end(), one) == warnings.end()) warnings.push_back(one);
      }
      if (swept.planned.run.outcome == Outcome::interrupted) break;
      runs.push_back(std::move(swept));
    }
  }
  write_report(choice, sweep_report(scene, runs));
  warn(warnings);
  if (runs.size() < values.size()) {
    plot.leave_out("interrupted");
    return interrupted_status;
  }
  const bool any =
      std::any_of(runs.begin(), runs.end(), [](const SweptRun& swept) { return !swept.planned.run.impacts.empty(); });
  if (!any) plot.leave_out("no impact was computed");
  else if (plot.is_wanted())
    plot.write(sweep_picture(scene, runs), run_words("simulate", "impact sequences, continuous contact", scene));
  return status_of(runs);
}

int run_simulate(const SimulateInput& input) {
  const Scene scene = read_scene_flags(input.scene);
  warn_of_law(input.scene, scene);
  const OutputChoice& choice = input.output;
  check_window(input, scene);
  require_states(input.states, scene);
  if (scene.sweep && scene.has_times()) throw BadInput("run.at, run.rate: left out with a table [sweep]");
  std::vector<RunFile> written = plot_files(input.plot);
  written.insert(written.begin(), {"--history", scene.history});
  check_files(choice, written);
  PlotFile plot(input.plot);
  const numeric::Body body = scene.make_body();
  return scene.sweep ? run_sweep(scene, body, choice, plot) : run_single(scene, body, input, plot);
}

}  // namespace

Command simulate_command() {
  return command_of<SimulateInput>(run_simulate, [](Command& command, SimulateInput& input) {
    add_scene_flags(command, input.scene);
    add_time_flags(command, input.scene);
    add_output_options(command, input.output);
    command.add(choice_argument("--rows", input.states, {"impacts", "states"},
                                "of CSV: at the times asked for (impacts)", "Output"));
    add_plot_options(command, input.plot);
    add_window_option(command, input.window, "of pictures and histories");
    command.footer =
        "Example: clatter simulate phone-damped --digits 8\n"
        "clatter help keys explains the keys of scene files, clatter init writes one with all of them.";
    command.columns = {{"simulate", simulation_columns}, {"history", history_columns}};
  });
}

}  // namespace clatter::validation
