// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/comparison_picture.hpp"

#include <fmt/format.h>

#include "validation/run/swept_column.hpp"

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

std::vector<PicturePanel> panels(const XAxis& axis, const std::vector<std::vector<double>>& rows) {
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
  FigurePlot impulses{.title = "",
                      .x_label = "",
                      .y_label = "normal impulse [N·s]",
                      .curves = {marks("discrete", "discrete"), marks("continuous", "continuous"),
                                 marks("limit", "limit on stiff ground")},
                      .x = axis.range,
                      .y = {0, no_number},
                      .whole_x = axis.is_number};
  FigurePlot deviations{
      .title = "",
      .x_label = axis.column.quantity + (axis.column.unit == "1" ? "" : " [" + axis.column.unit + "]"),
      .y_label = "largest deviation, relative",
      .curves = {marks("deviation", "|continuous − discrete|"), marks("predicted", "predicted size"),
                 marks("miss", "|limit − discrete|")},
      .x = axis.range,
      .y = {},
      .logarithmic_y = true,
      .whole_x = axis.is_number};
  return {{.columns = columns, .rows = rows, .plot = impulses}, {.columns = columns, .rows = rows, .plot = deviations}};
}

/// What the picture leaves out.
std::string parted_words(const PartedBlows& parted) {
  if (parted.from == 0) return "";
  return fmt::format("; from impact {} on they strike other blows and are left out: {}", parted.from, parted.reason);
}

}  // namespace

Picture comparison_picture(const Scene& scene, const Comparison& comparison) {
  std::vector<std::vector<double>> rows;
  for (const ComparedImpact& impact : comparison.impacts) rows.push_back(row_of(impact.n, comparison, impact));
  const XAxis axis{.column = {"x", "1", "number of the impact"},
                   .range = {0.5, static_cast<double>(rows.size()) + 0.5},
                   .is_number = true};
  return {.what = "Discrete and continuous model, impact by impact" + parted_words(comparison.parted),
          .scene = scene.summary(),
          .panels = panels(axis, rows)};
}

Picture swept_comparison_picture(const Scene& scene, const std::vector<SweptComparison>& swept) {
  std::vector<std::vector<double>> rows;
  for (const auto& [value, comparison] : swept) {
    if (!comparison.impacts.empty()) rows.push_back(row_of(value, comparison, comparison.impacts[0]));
  }
  const std::string unit = swept_column(*scene.sweep).unit;
  const XAxis axis{.column = {"x", unit.empty() ? "1" : unit, swept_words(*scene.sweep)},
                   .range = with_room(swept_range(swept.front().value, swept.back().value)),
                   .is_number = false};
  return {
      .what = "Discrete and continuous model, first impact", .scene = scene.summary(), .panels = panels(axis, rows)};
}

}  // namespace clatter::validation
