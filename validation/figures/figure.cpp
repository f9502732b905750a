// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/figures/figure.hpp"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <iterator>
#include <set>
#include <stdexcept>

#include "validation/output/bad_input.hpp"
#include "validation/output/json.hpp"
#include "validation/output/sink.hpp"
#include "validation/output/version.hpp"

namespace clatter::validation {

std::size_t column_index(const std::vector<FigureColumn>& columns, const std::string& name) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == name) return i;
  }
  throw std::out_of_range("no column " + name);
}

std::vector<std::string> curve_colours(const FigurePlot& plot) {
  static const char* const of_curves[]{blue,         red,       green,     pink,     palette::ochre,
                                       palette::sky, "#000000", "#8c564b", "#7f7f7f"};
  std::vector<std::string> colours;
  std::size_t next = 0;
  bool is_first = true;
  for (const FigureCurve& curve : plot.curves) {
    const bool is_area = curve.style == FigureCurve::Style::area;
    if (!is_area && !is_first && !curve.legend.empty()) ++next;
    if (!is_area) is_first = false;
    // Points without a name lie on the line before them.
    const bool is_on_line = curve.style == FigureCurve::Style::points && curve.legend.empty();
    const char* const own = is_area ? "" : is_on_line ? ink : of_curves[next % std::size(of_curves)];
    colours.push_back(curve.colour.empty() ? own : curve.colour);
  }
  return colours;
}

std::string Figure::label(const std::string& words, const std::string& column) const {
  std::string unit = columns[column_index(columns, column)].unit;
  for (const auto& [from, to] : {std::pair{"deg", "°"}, {"1", "–"}, {"N s", "N·s"}, {"|v_n|", "|vₙ|"}}) {
    if (const std::size_t at = unit.find(from); at != std::string::npos) unit.replace(at, std::strlen(from), to);
  }
  return fmt::format("{} [{}]", words, unit);
}

std::string Figure::command() const { return fmt::format("clatter figures --only {} --output DIR", number); }

const std::vector<int>& figure_numbers() {
  static const std::vector<int> numbers{7, 8, 9, 10, 11, 12, 14, 15, 16, 17, 19, 20, 21, 22, 23, 24};
  return numbers;
}

Figure make_figure(int number, CaseRuns& case_runs) {
  switch (number) {
    case 7: return figure_second_angle();
    case 8: return figure_rod_positions();
    case 9: return figure_two_impulses();
    case 10: return figure_both_angles();
    case 11: return figure_angles_with_gravity();
    case 12: return figure_impulses_with_gravity();
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

namespace {

Value range_value(const Range2& range) { return Value::List{range.low, range.high}; }

Value curve_fields(const FigureCurve& curve, const std::string& colour) {
  static const char* const styles[]{"line",        "dashed", "dotted", "points", "squares",  "crosses", "bars",
                                    "line-points", "marks",  "sticks", "area",   "segments", "regions"};
  Value::Fields fields{{"x", curve.x}, {"y", curve.y}, {"style", styles[static_cast<std::size_t>(curve.style)]}};
  for (const auto& [name, text] : {std::pair<const char*, const std::string&>{"legend", curve.legend},
                                   {"colour", colour},
                                   {"y_low", curve.y_low},
                                   {"x_end", curve.x_end},
                                   {"y_end", curve.y_end}}) {
    if (!text.empty()) fields.push_back({name, text});
  }
  if (curve.every > 1) fields.push_back({"every", curve.every});
  Value::Fields where;
  for (const auto& [column, value] : curve.where) where.push_back({column, value});
  if (!where.empty()) fields.push_back({"where", where});
  return fields;
}

}  // namespace

Value plot_fields(const FigurePlot& plot) {
  Value::List curves;
  const std::vector<std::string> colours = curve_colours(plot);
  for (std::size_t i = 0; i < colours.size(); ++i) curves.push_back(curve_fields(plot.curves[i], colours[i]));
  Value::Fields fields{{"title", plot.title},
                       {"x_label", plot.x_label},
                       {"y_label", plot.y_label},
                       {"x", range_value(plot.x)},
                       {"y", range_value(plot.y)},
                       {"x_factor", plot.x_factor},
                       {"legend_place", plot.legend_place},
                       {"equal_scales", plot.equal_scales},
                       {"curves", curves}};
  if (plot.ring) fields.push_back({"ring", true});
  if (plot.zoom) {
    const FigureZoom& z = *plot.zoom;
    fields.push_back({"zoom", Value::Fields{{"place", Value::List{z.left, z.bottom, z.width, z.height}},
                                            {"x", range_value(z.x)},
                                            {"title", z.title}}});
  }
  return fields;
}

Report figure_report(const Figure& figure) {
  Report report;
  report.title = fmt::format("Figure {}: {}", figure.number, figure.title);
  report.head = {"scene: " + figure.scene, "command: " + figure.command(), std::string("clatter ") + version};
  report.remarks = report.head;
  report.explains_columns = true;
  Value::List plots;
  for (const FigurePlot& plot : figure.plots) {
    plots.push_back(plot_fields(plot));
    report.remarks.push_back("plot: " + compact_json(plots.back()));
  }
  for (const FigureColumn& column : figure.columns) {
    report.grid.columns.push_back({column.name, column.name, column.unit == "1" ? "" : column.unit, column.quantity});
  }
  for (const std::vector<double>& row : figure.rows) report.grid.rows.emplace_back(row.begin(), row.end());
  report.fields = Value::Fields{{"clatter", version},
                                {"figure", figure.number},
                                {"title", figure.title},
                                {"scene", figure.scene},
                                {"command", figure.command()},
                                {"plots", plots},
                                {"rows", row_objects(report.grid)}};
  return report;
}

void make_folder(const std::string& folder, const std::string& option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::is_directory(folder, error)) return;
  throw BadInput(fmt::format("{} {}: must be a folder that exists or can be made", option, folder));
}

std::string FigureFiles::path(int number) const {
  const char* const extensions[]{"txt", "csv", "json", "md", "tex"};  // in the order of Format
  const char* const extension = extensions[static_cast<std::size_t>(style.format)];
  return (std::filesystem::path(folder) / fmt::format("figure_{:02}.{}", number, extension)).string();
}

void check_figure_files(const std::vector<int>& numbers, const FigureFiles& figures) {
  for (const int number : std::set<int>(numbers.begin(), numbers.end()))
    require_writable({"--output", figures.path(number)});
}

void write_figure(const Figure& figure, const FigureFiles& files) {
  Sink sink(files.path(figure.number));
  sink.write(report_text(figure_report(figure), files.style));
  sink.commit();
}

}  // namespace clatter::validation
