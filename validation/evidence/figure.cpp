// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/figure.hpp"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "validation/output/bad_input.hpp"
#include "validation/output/gnuplot.hpp"
#include "validation/output/json.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/version.hpp"

namespace clatter::validation {

std::string Figure::label(const std::string& words, const std::string& column) const {
  std::string unit = columns[column_index(columns, column)].unit;
  for (const auto& [from, to] : {std::pair{"deg", "°"}, {"1", "–"}, {"N s", "N·s"}, {"|v_n|", "|vₙ|"}}) {
    if (const std::size_t at = unit.find(from); at != std::string::npos) unit.replace(at, std::strlen(from), to);
  }
  return fmt::format("{} [{}]", words, unit);
}

std::string Figure::command() const { return fmt::format("clatter verify --figures --only {} --output DIR", number); }

const std::vector<int>& figure_numbers() {
  static const std::vector<int> numbers{7, 8, 9, 10, 11, 12, 14, 15, 16, 17, 19, 20, 21, 22, 23, 24};
  return numbers;
}
namespace {

Figure made(int number, CaseRuns& case_runs, const FigureParameters& parameters) {
  switch (number) {
    case 8: return figure_rod_positions(parameters.angles_deg);
    case 7:
    case 9:
    case 10:
    case 11:
    case 12: return figure_of_impacts(number, parameters.gravity_numbers);
    case 14: return figure_rod_over_angle(case_runs);
    case 15: return figure_rod_over_friction(case_runs);
    case 16: return figure_rod_contact(case_runs);
    case 17: return figure_rod_sequence(case_runs);
    case 19: return figure_phone_history(case_runs, false);
    case 20: return figure_phone_impacts(case_runs, false);
    case 21: return figure_phone_history(case_runs, true);
    case 22: return figure_phone_impacts(case_runs, true);
    case 23: return figure_phone_energies(case_runs);
    case 24: return figure_phone_over_angle(case_runs);
    default: throw std::out_of_range(fmt::format("no figure {}", number));
  }
}

/// @throws BadInput for what the figure does not have, or no figure of that kind.
void check(int number, const CaseRuns& case_runs, const FigureParameters& parameters) {
  const auto refuse = [&](const std::string& name) {
    const char* const has = number == 8   ? "angles"
                            : number < 14 ? "gravity_numbers"
                                          : "keys of scenes, as for simulate()";
    throw BadInput(fmt::format("{}: figure {} does not have it, but {}", name, number, has));
  };
  if (!parameters.angles_deg.empty() && number != 8) refuse("angles");
  if (!parameters.gravity_numbers.empty() && (number == 8 || number > 12)) refuse("gravity_numbers");
  if (!case_runs.changes.empty() && number < 14) refuse(case_runs.changes[0].flag);
  for (const SceneOverride& change : case_runs.changes) {
    if (number == 16 && change.key.ends_with("_friction"))
      throw BadInput(fmt::format("{}: must be left out, as figure 16 shows four frictions", change.flag));
  }
  for (const double angle : parameters.angles_deg) {
    if (!(angle > 0 && angle < 90))
      throw BadInput(fmt::format("angles {}: must be greater than 0 and less than 90 degrees", angle));
  }
  for (const double gravity : parameters.gravity_numbers) {
    if (!(gravity >= 0 && gravity < 1e9))
      throw BadInput(fmt::format("gravity_numbers {}: must be at least 0", gravity));
  }
  if (parameters.gravity_numbers.size() > 3) throw BadInput("gravity_numbers: must be three at most");
}

std::string script(const Figure& figure, const FigurePlot& plot, std::size_t index) {
  const PlotData data{figure.columns, figure.rows};
  return fmt::format(
             "set encoding utf8\nset terminal svg size 560,380 dynamic font 'sans-serif,13' background '#ffffff' name "
             "'f{}_{}'\n"
             "{}set key outside top center horizontal samplen 1.5\nset boxwidth 0.6\n",
             figure.number, index, axes_style) +
         fmt::format("set ylabel {}\n", gnuplot_quoted(plot.y_label)) + axes_text(data, plot) +
         data_blocks(data, plot, "$d") + plot_command(data, plot, "$d");
}

/// Without the declarations that only a file of its own may have.
std::string element(const std::string& svg) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) throw std::runtime_error("gnuplot drew nothing: " + svg.substr(0, 200));
  return svg.substr(begin);
}

}  // namespace

Figure make_figure(int number, CaseRuns& case_runs, const FigureParameters& parameters) {
  check(number, case_runs, parameters);
  Figure figure = made(number, case_runs, parameters);
  std::vector<std::string> words;
  if (!parameters.angles_deg.empty()) words.push_back(fmt::format("angles {}", fmt::join(parameters.angles_deg, ", ")));
  if (!parameters.gravity_numbers.empty())
    words.push_back(fmt::format("gravity_numbers {}", fmt::join(parameters.gravity_numbers, ", ")));
  for (const SceneOverride& change : case_runs.changes) words.push_back(fmt::format("{} {}", change.key, change.text));
  figure.changed = fmt::format("{}", fmt::join(words, "; "));
  return figure;
}

Report figure_report(const Figure& figure) {
  Report report;
  report.title = fmt::format("Figure {}: {}", figure.number, figure.title);
  report.head = {"scene: " + figure.scene,
                 figure.changed.empty() ? "command: " + figure.command() : "changed: " + figure.changed,
                 std::string("clatter ") + version};
  report.remarks = report.head;
  report.explains_columns = true;
  Value::List plots;
  for (const FigurePlot& plot : figure.plots) {
    plots.push_back(plot_fields(plot));
    report.remarks.push_back("plot: " + compact_json(plots.back()));
  }
  for (const FigureColumn& column : figure.columns)
    report.grid.columns.push_back({column.name, column.name, column.unit == "1" ? "" : column.unit, column.quantity});
  for (const std::vector<double>& row : figure.rows) report.grid.rows.emplace_back(row.begin(), row.end());
  report.fields = Value::Fields{{"clatter", version},
                                {"figure", figure.number},
                                {"title", figure.title},
                                {"scene", figure.scene},
                                {"command", text_or_nothing(figure.changed.empty() ? figure.command() : "")},
                                {"plots", plots},
                                {"rows", row_objects(report.grid)}};
  if (!figure.changed.empty()) report.fields["changed"] = figure.changed;
  return report;
}

std::vector<std::string> draw(const Figure& figure) {
  std::vector<FigurePlot> plots;
  for (const FigurePlot& plot : figure.plots) {
    plots.push_back(plot);
    if (!plot.zoom) continue;
    plots.push_back(plot);
    plots.back().title += (plot.title.empty() ? "" : ", ") + plot.zoom->title;
    plots.back().x = plot.zoom->x;
    plots.back().y.high = no_number;
  }
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < plots.size(); ++i) pictures.push_back(element(run_gnuplot(script(figure, plots[i], i))));
  return pictures;
}

}  // namespace clatter::validation
