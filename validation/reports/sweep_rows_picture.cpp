// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/sweep_rows_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation::inline reports {
namespace {

constexpr std::size_t most_curves = 8;
constexpr std::size_t most_marked_scenes = 60;  // of a curve whose points are marked

/// With blanks for underlines, behind which gnuplot lowers what follows.
std::string with_blanks(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string named(const Column& column) {
  return with_blanks(column.name) + (column.unit.empty() ? "" : fmt::format(" [{}]", column.unit));
}

std::vector<double> numbers_of(const Grid& grid, std::size_t column) {
  std::vector<double> numbers;
  for (const Row& row : grid.rows) {
    const double* const number = column < row.size() ? row[column].value.number() : nullptr;
    numbers.push_back(number ? *number : no_number);
  }
  return numbers;
}

std::size_t place_of(const Grid& grid, const std::string& name) {
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    if (grid.columns[i].name == name) return i;
  }
  throw BadInput(fmt::format("--plot: the rows have no column {}", name));
}

PicturePanel histogram(const Column& column, std::vector<double> values) {
  constexpr int classes = 40;
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  PicturePanel panel{
      .columns = {{"value", column.unit.empty() ? "1" : column.unit, column.name},
                  {"zero", "1", "no scene"},
                  {"scenes", "1", "scenes of this value"}},
      .rows = {},
      .plot = {
          .title = "",
          .x_label = named(column),
          .y_label = "scenes",
          .curves = {{.x = "value", .y = "scenes", .legend = "", .style = FigureCurve::Style::area, .y_low = "zero"}},
          .y = {0, no_number}}};
  if (values.empty()) return panel;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double low = *least, width = *greatest > low ? (*greatest - low) / classes : 1;
  std::vector<double> counts(classes, 0);
  for (const double value : values) {
    ++counts[std::min<std::size_t>(static_cast<std::size_t>((value - low) / width), classes - 1)];
  }
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double from = low + static_cast<double>(k) * width;
    panel.rows.push_back({from, 0, counts[k]});
    panel.rows.push_back({from + width, 0, counts[k]});
  }
  return panel;
}

/// Each quantity over the last swept key, a curve for each value of the key before it.
PicturePanel curves(const Grid& grid, const SweepRowsView& view, std::size_t quantity) {
  const std::size_t over = view.first_swept + view.swept - 1;
  const std::vector<double> x = numbers_of(grid, over), y = numbers_of(grid, quantity);
  const std::vector<double> of = view.swept > 1 ? numbers_of(grid, view.first_swept) : std::vector<double>(x.size(), 0);
  const Column& column = grid.columns[quantity];
  PicturePanel panel{.columns = {{"x", "1", named(grid.columns[over])},
                                 {"y", column.unit.empty() ? "1" : column.unit, column.name},
                                 {"of", "1", named(grid.columns[view.first_swept])}},
                     .rows = {},
                     .plot = {.title = "", .x_label = "", .y_label = named(column), .curves = {}}};
  for (std::size_t i = 0; i < x.size(); ++i) panel.rows.push_back({x[i], y[i], of[i]});
  for (const double value : std::set<double>(of.begin(), of.end())) {
    panel.plot.curves.push_back(
        {.x = "x",
         .y = "y",
         .legend = view.swept > 1 ? with_blanks(grid.columns[view.first_swept].name) + " = " + shortest(value) : "",
         .style = x.size() > most_marked_scenes ? FigureCurve::Style::line : FigureCurve::Style::line_points,
         .where = {{"of", value}}});
  }
  return panel;
}

/// Whether the rows are few curves over the last key.
bool has_curves(const Grid& grid, const SweepRowsView& view) {
  if (view.random || view.swept == 0 || view.swept > 2) return false;
  for (std::size_t i = 0; i < view.swept; ++i) {
    for (const double value : numbers_of(grid, view.first_swept + i)) {
      if (!std::isfinite(value)) return false;
    }
  }
  const std::vector<double> first = numbers_of(grid, view.first_swept);
  return view.swept == 1 || std::set<double>(first.begin(), first.end()).size() <= most_curves;
}

}  // namespace

Picture sweep_rows_picture(const Report& report, const SweepRowsView& view) {
  Picture picture{.what = "Many scenes", .scene = report.head, .panels = {}};
  const bool over_a_key = has_curves(report.grid, view);
  for (const std::string& name : view.quantities) {
    const std::size_t quantity = place_of(report.grid, name);
    picture.panels.push_back(over_a_key ? curves(report.grid, view, quantity)
                                        : histogram(report.grid.columns[quantity], numbers_of(report.grid, quantity)));
  }
  if (over_a_key) picture.panels.back().plot.x_label = named(report.grid.columns[view.first_swept + view.swept - 1]);
  return picture;
}

}  // namespace clatter::validation::inline reports
