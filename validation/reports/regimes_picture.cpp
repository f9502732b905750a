// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/regimes_picture.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::validation::inline reports {
namespace {

using analytic::BoundaryKind;
using analytic::degrees_per_radian;
using analytic::RegimeBoundary;
using Style = FigureCurve::Style;

constexpr std::size_t most_marked = 60;  // so few values are marked on their curves

/// [°]; without such an impact the area of fewer impacts begins at 0.
double boundary(const RegimeBoundary& b) { return b.kind == BoundaryKind::never ? 0 : b.theta * degrees_per_radian; }

std::vector<double> row_of(const Regimes& one) {
  const auto angle = [](const RegimeBoundary& b) {
    return b.kind == BoundaryKind::never ? std::nan("") : b.theta * degrees_per_radian;
  };
  return {one.value, angle(one.second), angle(one.third), 0, boundary(one.third), boundary(one.second), 90};
}

FigureCurve area(const RegimesAxis& axis, const char* low, const char* high, const char* legend) {
  return {.x = axis.name, .y = high, .legend = legend, .style = Style::area, .y_low = low};
}

Range2 range_of(const std::vector<Regimes>& all, const RegimesAxis& axis) {
  const auto [low, high] = std::minmax_element(
      all.begin(), all.end(), [](const Regimes& one, const Regimes& other) { return one.value < other.value; });
  if (axis.logarithmic) return {};
  const double room = low->value == 0 ? 0.5 : std::fabs(low->value) / 2;  // about a single point
  if (low->value == high->value) return {low->value - room, high->value + room};
  return {low->value, high->value};
}

}  // namespace

Picture regimes_picture(const std::vector<Regimes>& all, const RegimesAxis& axis, const std::string& rod) {
  const bool leaves_out =
      axis.logarithmic && std::any_of(all.begin(), all.end(), [](const Regimes& one) { return !(one.value > 0); });
  const Style style = all.size() > most_marked ? Style::line : all.size() > 1 ? Style::line_points : Style::marks;
  PicturePanel panel{.columns = {{axis.name, "1", axis.words},
                                 {"theta_2_deg", "°", "largest θ with a second impact"},
                                 {"theta_3_deg", "°", "largest θ with a third impact"},
                                 {"zero", "°", "least θ"},
                                 {"below_3", "°", "three impacts below"},
                                 {"below_2", "°", "two impacts or more below"},
                                 {"upright", "°", "greatest θ"}},
                     .rows = {},
                     .plot = {.title = "",
                              .x_label = axis.words + (leaves_out ? " (0 lies off this axis)" : ""),
                              .y_label = "contact angle θ of the first impact [°]",
                              .curves = {},
                              .x = range_of(all, axis),
                              .y = {0, 90},
                              .logarithmic_x = axis.logarithmic}};
  for (const Regimes& one : all) panel.rows.push_back(row_of(one));
  if (all.size() > 1) {
    panel.plot.curves = {area(axis, "zero", "below_3", "three impacts"),
                         area(axis, "below_3", "below_2", "two impacts"),
                         area(axis, "below_2", "upright", "one impact")};
  }
  for (const auto& [column, legend] : {std::pair{"theta_2_deg", "θ₂"}, std::pair{"theta_3_deg", "θ₃"}}) {
    panel.plot.curves.push_back({.x = axis.name, .y = column, .legend = legend, .style = style});
  }
  return {.what = "How many impacts, and where that changes", .scene = {rod}, .panels = {panel}};
}

}  // namespace clatter::validation::inline reports
