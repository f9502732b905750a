// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "validation/benchmark/benchmark_report.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/compare/comparison.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/output/picture.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {
namespace {

using Style = FigureCurve::Style;

/// What the impacts are drawn over.
struct XAxis {
  FigureColumn column;
  Range2 range;
  bool is_number;  ///< of the impact
};

/// The numbers of one impact, NaN where there is none to show: of another blow than the discrete model's none.
std::vector<double> row_of(double x, const Comparison& comparison, const ComparedImpact& impact) {
  std::vector<double> row{x, no_number, no_number, no_number, no_number, no_number, no_number};
  const bool is_one = comparison.parted.are_one(impact.n);
  if (impact.discrete && (is_one || impact.has_landing())) row[1] = (*impact.discrete)[normal_impulse_place];
  if (impact.continuous && is_one) row[2] = (*impact.continuous)[normal_impulse_place];
  if (impact.has_landing()) row[3] = impact.limit->value[normal_impulse_place];
  if (!impact.discrete) return row;
  const WorstNumber worst = worst_number(comparison, impact);
  if (impact.reason.empty()) {
    row[4] = worst.deviation;
    row[5] = worst.predicted;
  }
  if (impact.has_landing()) row[6] = worst.miss;
  return row;
}

/// Marks do not lie on the frame.
Range2 with_room(const Range2& range) {
  const double room = 0.02 * (range.high - range.low);
  return {range.low - room, range.high + room};
}

/// @param discrete  legend of the discrete model's numbers
std::vector<PicturePanel> panels(const XAxis& axis, const std::vector<std::vector<double>>& rows,
                                 const char* discrete) {
  const std::vector<FigureColumn> columns{axis.column,
                                          {"discrete", "N·s", "normal impulse, discrete model"},
                                          {"continuous", "N·s", "normal impulse, continuous model"},
                                          {"limit", "N·s", "normal impulse, stiff limit of the continuous model"},
                                          {"deviation", "1", "largest deviation, relative"},
                                          {"predicted", "1", "its predicted size"},
                                          {"miss", "1", "worst distance of the stiff limit, relative"}};
  const auto marks = [](const char* column, const char* legend) {
    return FigureCurve{.x = "x", .y = column, .legend = legend, .style = Style::marks};
  };
  FigurePlot impulses{.y_label = "normal impulse [N·s]",
                      .curves = {marks("discrete", discrete), marks("continuous", "continuous"),
                                 marks("limit", "limit on stiff ground")},
                      .x = axis.range,
                      .y = {0, no_number},
                      .whole_x = axis.is_number};
  FigurePlot deviations{
      .x_label = axis.column.quantity + (axis.column.unit == "1" ? "" : " [" + axis.column.unit + "]"),
      .y_label = "largest deviation, relative",
      .curves = {marks("deviation", "|continuous − discrete|"), marks("predicted", "predicted size"),
                 marks("miss", "|limit − discrete|")},
      .x = axis.range,
      .logarithmic_y = true,
      .whole_x = axis.is_number};
  return {{.columns = columns, .rows = rows, .plot = impulses}, {.columns = columns, .rows = rows, .plot = deviations}};
}

/// Both models are drawn with the same corners, which a table has in a column of their own.
const char* discrete_legend(const Comparison& comparison) {
  return comparison.as_given ? "discrete, corners of the mesh" : "discrete";
}

/// What the picture leaves out.
std::string parted_words(const PartedBlows& parted) {
  if (parted.from == 0) return "";
  return fmt::format("; from impact {} on they strike other blows and are left out: {}", parted.from, parted.reason);
}

/// Normal impulses over the number of the impact, and how far each impact's worst number deviates.
Picture comparison_picture(const Scene& scene, const Comparison& comparison) {
  std::vector<std::vector<double>> rows;
  for (const ComparedImpact& impact : comparison.impacts) rows.push_back(row_of(impact.n, comparison, impact));
  const XAxis axis{.column = {"x", "1", "number of the impact"},
                   .range = {0.5, static_cast<double>(rows.size()) + 0.5},
                   .is_number = true};
  return {.what = "Discrete and continuous model, impact by impact" + parted_words(comparison.parted),
          .scene = scene.summary(),
          .panels = panels(axis, rows, discrete_legend(comparison))};
}

/// The same of the first impact over the swept value.
Picture swept_comparison_picture(const Scene& scene, const std::vector<SweptComparison>& swept) {
  std::vector<std::vector<double>> rows;
  for (const auto& [value, comparison] : swept) {
    if (!comparison.impacts.empty()) rows.push_back(row_of(value, comparison, comparison.impacts[0]));
  }
  const std::string unit = swept_column(*scene.sweep).unit;
  const XAxis axis{.column = {"x", unit.empty() ? "1" : unit, swept_words(*scene.sweep)},
                   .range = with_room(swept_range(swept.front().value, swept.back().value)),
                   .is_number = false};
  return {.what = "Discrete and continuous model, first impact",
          .scene = scene.summary(),
          .panels = panels(axis, rows, discrete_legend(swept.front().comparison))};
}

const char* const comparison_summary = "discrete and continuous model, impact by impact";

struct CompareInput {
  SceneFlags scene;
  std::vector<std::string> against;
  ColumnNames columns;
  std::optional<Requirement> require;
  bool details = false;
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
  const Requirement requirement = input.require.value_or(Requirement{});
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  const Reference reference = reference_of(scene);
  std::vector<Submission> submissions;
  bool is_met = true;
  for (const std::string& file : input.against) {
    submissions.push_back(judge_file(file, reference, input.columns));
    is_met = meets(submissions.back(), requirement) && is_met;
  }
  name_apart(submissions);
  write_report(choice, against_report(prepared(scene).scene, reference, submissions, input.details));
  if (plot.is_wanted()) {
    const Picture picture = score_picture(submissions);
    plot.write(picture, run_words("compare", picture.what, scene));
  }
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
  if (plot.is_wanted())
    plot.write(swept_comparison_picture(scene, swept), run_words("compare", comparison_summary, scene));
  const bool agree =
      std::all_of(swept.begin(), swept.end(), [](const SweptComparison& one) { return one.comparison.agrees(); });
  return agree ? status_of(swept) : check_failed;
}

int run_compare(const CompareInput& input) {
  if (!input.against.empty()) return compare_foreign(input);
  if (!input.columns.empty()) throw BadInput("--columns: only with --against");
  if (input.require) throw BadInput("--require: only with --against");
  if (input.details) throw BadInput("--details: only with --against");
  const Scene scene = read_scene_flags(input.scene);
  const OutputChoice& choice = input.output;
  if (is_given(input.scene, "--history")) throw BadInput("--history: compare writes none; clatter simulate does");
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  return scene.sweep ? compare_swept(scene, choice, plot) : compare_one(scene, choice, plot);
}

}  // namespace

Command compare_command() {
  return command_of<CompareInput>(run_compare, [](Command& command, CompareInput& input) {
    add_scene_flags(command, input.scene);
    command.add_list("--against", input.against, "FILE",
                     "score these runs of another program, as clatter benchmark does");
    command.add(read_argument("--columns", input.columns, read_column_names, "NAME=COLUMN,...",
                              "what the files of --against call their columns"));
    command.add(
        read_argument("--require", input.require, read_requirement, "CLASS",
                      "of --against: exact|sharp|good|coarse|incomplete, or a largest error of complete answers"));
    command.add_flag("--details", input.details, "of --against: all errors, causes and findings of each file");
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer =
        "Example: clatter compare phone-damped --impacts 2\n"
        "         clatter compare phone-corner --impacts 8 (in space, corner by corner)\n"
        "With --against FILE a foreign run is judged by the discrete model: its impacts, velocities, times, energy.\n"
        "Exit status 1 if the stiff limit of the continuous model misses the discrete value or a run of --against is "
        "worse\n"
        "than --require, without which it is 0 whatever the verdict,\n"
        "3 if a limit or a number that could not be computed left fewer impacts than asked for,\n"
        "4 if nothing can be compared.";
    command.columns = {{"compare", comparison_columns}};
  });
}

}  // namespace clatter::validation
