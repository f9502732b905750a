// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter columns`: every column of CSV and JSON, by command.
#include <algorithm>
#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/record/history_file.hpp"
#include "validation/record/impact_rows.hpp"
#include "validation/reports/angles_report.hpp"
#include "validation/reports/benchmark_report.hpp"
#include "validation/reports/comparison_report.hpp"
#include "validation/reports/explanation_report.hpp"
#include "validation/reports/extremes_report.hpp"
#include "validation/reports/measured_report.hpp"
#include "validation/reports/plan_report.hpp"
#include "validation/reports/regimes_report.hpp"
#include "validation/reports/score_report.hpp"
#include "validation/reports/sequence_report.hpp"
#include "validation/reports/simulation_report.hpp"
#include "validation/reports/tradeoff_report.hpp"
#include "validation/reports/verify_report.hpp"
#include "validation/scene/option_values.hpp"
#include "validation/sweep/rows.hpp"

namespace clatter::validation::inline cli {
namespace {

struct ColumnsInput {
  std::optional<std::string> command;
  OutputTexts output;
};

/// A command and what asks for its columns.
struct ColumnsOf {
  const char* command;
  std::vector<Column> (*columns)();
};

SweepPlan sweep_of(Model model) {
  SweepPlan plan;
  plan.model = model;
  return plan;
}

std::vector<Column> angles_all() {
  AnglesRequest request;
  request.as_printed = true;
  return angles_frame(request).grid.columns;
}
/// In the plane, and what comes to them in space.
std::vector<Column> sequence_all() {
  std::vector<Column> all = sequence_columns();
  for (const Column& column : impact_columns<SpaceRow>({})) {
    const auto is_it = [&](const Column& other) { return other.name == column.name; };
    if (std::none_of(all.begin(), all.end(), is_it)) all.push_back(column);
  }
  return all;
}
std::vector<Column> sweep_all() { return sweep_columns(sweep_of(Model::continuous)); }

const std::vector<ColumnsOf>& all_columns() {
  static const std::vector<ColumnsOf> all{{"sequence", sequence_all},
                                          {"angles", angles_all},
                                          {"regimes", regimes_columns},
                                          {"explain", explain_columns},
                                          {"simulate", simulation_columns},
                                          {"history", history_columns},
                                          {"compare", comparison_columns},
                                          {"sweep", sweep_all},
                                          {"verify", verify_columns},
                                          {"plan", plan_columns},
                                          {"tradeoff", tradeoff_columns},
                                          {"extremes", extremes_columns},
                                          {"benchmark-list", benchmark_list_columns},
                                          {"benchmark-truth", benchmark_truth_columns},
                                          {"benchmark-score", score_columns},
                                          {"measured-fit", measured_fit_columns},
                                          {"measured-predict", measured_predict_columns},
                                          {"measured-score", measured_score_columns}};
  return all;
}

Report columns_report(const std::string& command) {
  Report report = begun_report("columns", "the columns of CSV, which are the names in JSON");
  report.grid.columns = {word_column("command", "command", "that writes the column"),
                         word_column("column", "column", "its name"), word_column("unit", "unit", "its unit"),
                         word_column("meaning", "meaning", "what its numbers are")};
  for (const ColumnsOf& of : all_columns()) {
    if (!command.empty() && command != of.command) continue;
    for (const Column& column : of.columns()) {
      report.grid.rows.push_back({Cell(of.command), Cell(column.name), Cell(column.unit), Cell(column.meaning)});
    }
  }
  report.notes = {
      "history: of simulate --history.  sweep: one row per scene; with --rows impact the columns of sequence or "
      "simulate.  Before them come the swept keys, which clatter keys explains.  The files of figures explain theirs.",
      "corners, place, attitude and touches of a sequence are those of a drop in space; in the plane they are left "
      "out."};
  report.fields["columns"] = row_objects(report.grid);
  return report;
}

int run_columns(const ColumnsInput& input) {
  const OutputChoice choice = read_output(input.output);
  if (input.command) {
    std::vector<std::string> names;
    for (const ColumnsOf& of : all_columns()) names.emplace_back(of.command);
    static_cast<void>(read_name_option("--only", *input.command, names));
  }
  check_files(choice);
  write_report(choice, columns_report(input.command.value_or("")));
  return 0;
}

}  // namespace

Command columns_command() {
  auto input = std::make_shared<ColumnsInput>();
  Command command{.name = "columns", .help = "every column of CSV and JSON, its unit and meaning"};
  command.add_text("--only", input->command, "COMMAND", "the columns of this one alone");
  add_output_options(command, input->output);
  command.footer = "Example: clatter columns --only sequence --format markdown";
  command.run = [input] { return run_columns(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
