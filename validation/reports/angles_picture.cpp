// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/angles_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cmath>

#include "validation/scene/rod_parameters.hpp"

namespace clatter::validation::inline reports {
namespace {

using Style = FigureCurve::Style;

constexpr long long most_rows = 4000;
constexpr long long most_with_points = 60;  // so few rows are marked on their curves
using Existing = std::bitset<std::tuple_size_v<AnglesRow>>;

/// Which numbers a row has.
Existing existing(const AnglesRow& row) {
  Existing bits;
  for (std::size_t k = 0; k < row.size(); ++k) bits[k] = !std::isnan(row[k]);
  return bits;
}

std::vector<double> as_vector(const AnglesRow& row) { return {row.begin(), row.end()}; }

/// Adds the rows on both sides of each change in what exists between row `low`, which is there already, and `high`.
void add_ends(const AnglesRequest& request, long long low, long long high, std::vector<std::vector<double>>& rows) {
  const Existing at_high = existing(angles_row(request, high));
  for (Existing at_low = existing(angles_row(request, low)); at_low != at_high;) {
    long long last = low, next = high;
    while (next - last > 1) {
      const long long middle = last + (next - last) / 2;
      (existing(angles_row(request, middle)) == at_low ? last : next) = middle;
    }
    const AnglesRow other = angles_row(request, next);
    if (last != low) rows.push_back(as_vector(angles_row(request, last)));
    if (next == high) return;
    rows.push_back(as_vector(other));
    low = next;
    at_low = existing(other);
  }
}

std::vector<std::vector<double>> drawn_rows(const AnglesRequest& request) {
  const long long last = request.count - 1, step = last / most_rows + 1;
  std::vector<std::vector<double>> rows{as_vector(angles_row(request, 0))};
  for (long long i = 0; i < last;) {
    const long long next = std::min(i + step, last);
    if (step > 1) add_ends(request, i, next, rows);
    rows.push_back(as_vector(angles_row(request, next)));
    i = next;
  }
  return rows;
}

std::vector<FigureColumn> figure_columns(const AnglesRequest& request) {
  std::vector<FigureColumn> columns;
  for (const Column& column : angles_columns(request)) {
    columns.push_back({column.name, column.unit.empty() ? "1" : column.unit, column.heading});
  }
  return columns;
}

Range2 range_of(const AnglesRequest& request) {
  const double first = request.theta(0), last = request.theta(request.count - 1);
  return first < last ? Range2{first, last} : Range2{first - 1, last + 1};  // a point needs room about it
}

}  // namespace

Picture angles_picture(const AnglesRequest& request) {
  const long long count = request.count;
  const Style style = count > most_with_points ? Style::line : count > 1 ? Style::line_points : Style::marks;
  const auto curve = [&](const char* column, const char* legend) {
    return FigureCurve{.x = "theta_deg", .y = column, .legend = legend, .style = style};
  };
  const std::vector<FigureColumn> columns = figure_columns(request);
  const auto rows = drawn_rows(request);
  const Range2 range = range_of(request);
  PicturePanel angles{.columns = columns,
                      .rows = rows,
                      .plot = {.title = "",
                               .x_label = "",
                               .y_label = "contact angle [°]",
                               .curves = {curve("beta_deg", "β, second impact")},
                               .x = range,
                               .y = {0, 90}}};
  if (request.as_printed) {
    angles.plot.curves.push_back(curve("beta_printed_deg", "β as printed, g > 0"));
    angles.plot.curves.push_back(curve("beta_printed_negative_g_deg", "β as printed, g < 0"));
  } else {
    angles.plot.curves.push_back(curve("gamma_deg", "γ, third impact"));
  }
  const PicturePanel impulses{.columns = columns,
                              .rows = rows,
                              .plot = {.title = "",
                                       .x_label = "contact angle θ of the first impact [°]",
                                       .y_label = "normal impulse [m|vₙ|]",
                                       .curves = {curve("P1", "P₁"), curve("P2", "P₂"), curve("P3", "P₃")},
                                       .x = range,
                                       .y = {0, no_number}}};
  return {.what = "Contact angles and impulses of the first three impacts",
          .scene = {rod_summary(request.rod)},
          .panels = {angles, impulses}};
}

}  // namespace clatter::validation::inline reports
