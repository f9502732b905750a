// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "validation/benchmark/score_report.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/command/progress.hpp"
#include "validation/compare/comparison_picture.hpp"
#include "validation/compare/swept_comparison_report.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {
namespace {

const char* const comparison_summary = "discrete and continuous model, impact by impact";

struct CompareInput {
  SceneFlags scene;
  std::vector<std::string> against;
  ColumnNames columns;
  std::optional<Requirement> require;
  OutputChoice output;
  PlotChoice plot;
};

/// Foreign runs of the scene against the discrete model.
int compare_foreign(const CompareInput& input) {
  SceneFlags flags = input.scene;
  flags.model = Model::discrete;
  const Scene scene = read_scene_flags(flags);
  const OutputChoice& choice = input.output;
  if (scene.sweep) throw BadInput(fmt::format("{}: --against takes a scene that sweeps nothing", scene.path));
  if (!input.plot.path.empty()) throw BadInput("--plot: not with --against");
  const Requirement requirement = input.require.value_or(Requirement{});
  check_files(choice);
  const Reference reference = reference_of(scene);
  std::vector<Submission> submissions;
  bool is_met = true;
  for (const std::string& file : input.against) {
    submissions.push_back(judge_file(file, reference, input.columns));
    is_met = is_met && requirement.is_met(submissions.back());
  }
  write_report(choice, against_report(prepared(scene).scene, reference, submissions));
  return is_met ? 0 : check_failed;
}

int compare_one(const Scene& scene, const OutputChoice& choice, PlotFile& plot) {
  const Comparison comparison = compare_models(scene, scene.make_body());
  write_report(choice, comparison_report(scene, comparison));
  if (comparison.impacts.empty()) plot.leave_out("no impact");
  else if (!comparison.parted.are_one(1) && !comparison.impacts.front().has_landing())
    plot.leave_out(comparison.parted.reason);
  else if (plot.is_wanted())
    plot.write(comparison_picture(scene, comparison), run_words("compare", comparison_summary, scene));
  if (!comparison.agrees()) return check_failed;
  if (!comparison.shortfall.empty()) {
    say(comparison.shortfall);
    return exit_status(FailureKind::not_computed);
  }
  if (comparison.has_content()) return 0;
  say("nothing could be compared: " +
      (comparison.impacts.empty() ? comparison.run.message : comparison.impacts[0].reason));
  return exit_status(FailureKind::outside_model);
}

int status_of(const std::vector<SweptComparison>& swept) {
  Shortfalls shortfalls;
  for (const auto& [value, comparison] : swept) shortfalls.add(shortest(value), comparison.shortfall);
  return shortfalls.status(static_cast<long long>(swept.size()), "values");
}

int compare_swept(const Scene& scene, const OutputChoice& choice, PlotFile& plot) {
  const CooperativeInterrupt interrupt;
  const std::vector<double> values = scene.sweep->values();
  const numeric::Body body = scene.make_body();
  std::vector<SweptComparison> swept;
  {
    Progress progress;
    for (const double value : values) {
      if (interrupt.requested()) break;
      progress.show(progress_bar(swept.size(), values.size()));
      swept.push_back({value, compare_models(scene.at(value), body)});
    }
  }
  write_report(choice, swept_comparison_report(scene, swept));
  if (swept.size() < values.size()) {
    plot.leave_out("interrupted");
    return interrupted_status;
  }
  if (plot.is_wanted()) {
    plot.write(swept_comparison_picture(scene, swept), run_words("compare", comparison_summary, scene));
  }
  const bool agree =
      std::all_of(swept.begin(), swept.end(), [](const SweptComparison& one) { return one.comparison.agrees(); });
  return agree ? status_of(swept) : check_failed;
}

int run_compare(const CompareInput& input) {
  if (!input.against.empty()) return compare_foreign(input);
  if (!input.columns.empty()) throw BadInput("--columns: only with --against");
  if (input.require) throw BadInput("--require: only with --against");
  const Scene scene = read_scene_flags(input.scene);
  const OutputChoice& choice = input.output;
  if (is_given(input.scene, "--history")) throw BadInput("--history: compare writes none; clatter simulate does");
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  return scene.sweep ? compare_swept(scene, choice, plot) : compare_one(scene, choice, plot);
}

}  // namespace

Command compare_command() {
  auto input = std::make_shared<CompareInput>();
  Command command;
  add_scene_flags(command, input->scene);
  command.add_list("--against", input->against, "FILE",
                   "score these runs of another program, as clatter benchmark does");
  command.add(read_argument("--columns", input->columns, read_column_names, "NAME=COLUMN,...",
                            "what the files of --against call their columns"));
  command.add(
      read_argument("--require", input->require, read_requirement, "CLASS",
                    "of --against: exact|sharp|good|coarse|incomplete, or a largest error of complete answers"));
  add_output_options(command, input->output);
  add_plot_options(command, input->plot);
  command.footer =
      "Example: clatter compare phone-damped --impacts 2\n"
      "         clatter compare phone-corner --impacts 8 (in space, corner by corner)\n"
      "With --against FILE a foreign run is judged by the discrete model: its impacts, velocities, times, energy.\n"
      "Exit status 1 if the stiff limit of the continuous model misses the discrete value or a run of --against is "
      "worse\n"
      "than --require, without which it is 0 whatever the verdict,\n"
      "3 if a limit or a number that could not be computed left fewer impacts than asked for,\n"
      "4 if nothing can be compared.";
  command.run = [input] { return run_compare(*input); };
  return command;
}

}  // namespace clatter::validation
