// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/figures/plot_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "validation/figures/gnuplot.hpp"
#include "validation/figures/thinning.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation::inline figures {
namespace {

using Style = FigureCurve::Style;

/// The palette, pale enough for lines on top.
constexpr std::array<const char*, 3> area_colours{"#bcd9ea", "#f6d3ba", "#c4e5da"};
constexpr std::array<int, 6> shapes{6, 2, 4, 8, 10, 12};

std::string range(const Range2& range) {
  const auto bound = [](double value) { return std::isfinite(value) ? shortest(value) : std::string("*"); };
  return fmt::format("[{}:{}]", bound(range.low), bound(range.high));
}

bool within(double x, const Range2& range) { return !(x < range.low) && !(x > range.high); }

/// The number in a column, NaN if the row ends before it or the axis cannot show it.
double number_at(const std::vector<double>& row, std::size_t column, bool logarithmic) {
  if (column >= row.size() || (logarithmic && !(row[column] > 0))) return std::nan("");
  return row[column];
}

std::vector<CurvePoint> points_of(const PlotData& data, const FigurePlot& plot, const FigureCurve& curve) {
  const std::size_t x = column_index(data.columns, curve.x), y = column_index(data.columns, curve.y);
  const bool is_area = curve.style == Style::area;
  const bool is_segment = curve.style == Style::segments;
  const std::size_t low = is_area ? column_index(data.columns, curve.y_low) : 0;
  const std::size_t x_end = is_segment ? column_index(data.columns, curve.x_end) : 0;
  const std::size_t y_end = is_segment ? column_index(data.columns, curve.y_end) : 0;
  std::vector<CurvePoint> points;
  for (const std::vector<double>& row : data.rows) {
    const bool is_chosen = std::all_of(curve.where.begin(), curve.where.end(), [&](const auto& one) {
      return row[column_index(data.columns, one.first)] == one.second;
    });
    if (!is_chosen) continue;
    const double at = plot.x_factor * number_at(row, x, plot.logarithmic_x);
    if (!std::isfinite(at) || !within(at, plot.x)) continue;
    CurvePoint point{at, number_at(row, y, plot.logarithmic_y)};
    if (is_area) point.low = number_at(row, low, false);
    if (is_segment) point.x_end = number_at(row, x_end, false), point.y_end = number_at(row, y_end, false);
    const bool ends_nothing = points.empty() || points.back().is_gap();
    if (!point.is_gap() || !ends_nothing) points.push_back(point);
  }
  return points;
}

bool has_gaps(Style style) {
  return style == Style::line || style == Style::dashed || style == Style::dotted || style == Style::line_points ||
         style == Style::area;
}

bool has_numbers(const PlotData& data, const FigurePlot& plot, const FigureCurve& curve) {
  return !points_of(data, plot, curve).empty();  // a gap is only kept after a point
}

bool has_numbers(const PlotData& data, const FigurePlot& plot) {
  return std::any_of(plot.curves.begin(), plot.curves.end(),
                     [&](const FigureCurve& curve) { return has_numbers(data, plot, curve); });
}

std::string column_words(const PlotData& data, const std::string& name) {
  const FigureColumn& column = data.columns[column_index(data.columns, name)];
  return column.quantity + (column.unit == "1" ? "" : fmt::format(" [{}]", column.unit));
}

/// Rows of a curve as a gnuplot data block; gaps become empty lines.
std::string data_block(const PlotData& data, const FigurePlot& plot, const FigureCurve& curve,
                       const std::string& name) {
  const bool is_area = curve.style == Style::area, is_segment = curve.style == Style::segments;
  std::string text = fmt::format("{} << END\n# {}; {}{}\n", name, column_words(data, curve.x),
                                 is_area ? column_words(data, curve.y_low) + "; " : "", column_words(data, curve.y));
  for (const CurvePoint& point : thinned(points_of(data, plot, curve))) {
    if (!point.is_gap()) {
      text += shortest(point.x) + " " + (is_area ? shortest(point.low) + " " : "") + shortest(point.y) +
              (is_segment ? " " + shortest(point.x_end) + " " + shortest(point.y_end) : "") + "\n";
    } else if (has_gaps(curve.style)) {
      text += "\n";
    }
  }
  return text + "END\n";
}

/// How many areas and marks the curves before have used.
struct Used {
  std::size_t areas = 0, marks = 0;

  void add(Style style) {
    if (style == Style::area) ++areas;
    if (style == Style::marks) ++marks;
  }
};

std::string style_text(Style style, const std::string& colour, const Used& used) {
  const auto drawn = [&](const char* how) { return fmt::format("with {} lc rgb '{}'", how, colour); };
  switch (style) {
    case Style::line: return drawn("lines lw 2");
    case Style::dashed: return drawn("lines lw 1.2 dt 2");
    case Style::dotted: return drawn("lines lw 1.5 dt 3");
    case Style::points: return drawn("points pt 6 ps 0.6");
    case Style::squares: return drawn("points pt 4 ps 0.6");
    case Style::crosses: return drawn("points pt 2 ps 0.7");
    case Style::bars: return drawn("boxes fs solid 0.6");
    case Style::line_points: return drawn("linespoints lw 2 pt 7 ps 0.35");
    case Style::marks:
      return drawn(
          fmt::format("points pt {} ps {} lw 1.8", shapes[used.marks % shapes.size()], used.marks == 0 ? 1.5 : 1)
              .c_str());
    case Style::sticks: return drawn("impulses lw 2");
    case Style::segments: return "with vectors nohead lw 2 lc palette";
    case Style::area:
      return fmt::format("with filledcurves fs solid noborder lc rgb '{}'",
                         area_colours[used.areas % area_colours.size()]);
  }
  return "";
}

const char* columns_text(Style style) {
  if (style == Style::segments) return "1:2:($3-$1):($4-$2):0";
  return style == Style::area ? "1:2:3" : "1:2";
}

/// Least and greatest number of the plot's curves on one axis, widened to whole decades that begin and end `margin`
/// decades or more beyond them.
Range2 decades(const PlotData& data, const FigurePlot& plot, double CurvePoint::*axis, double margin) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const FigureCurve& curve : plot.curves) {
    for (const CurvePoint& point : points_of(data, plot, curve)) {
      if (point.is_gap()) continue;
      least = std::min(least, point.*axis);
      greatest = std::max(greatest, point.*axis);
    }
  }
  if (!(greatest > 0)) return {};
  const double low = std::floor(std::log10(least) - margin), high = std::ceil(std::log10(greatest) + margin);
  return {std::pow(10, low), std::pow(10, std::max(high, low + 1))};
}

bool is_given(const Range2& range) { return std::isfinite(range.low) || std::isfinite(range.high); }

}  // namespace

std::string data_blocks(const PlotData& data, const FigurePlot& plot, const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    if (has_numbers(data, plot, plot.curves[i]))
      text += data_block(data, plot, plot.curves[i], name + std::to_string(i));
  }
  return text;
}

std::string axes_text(const PlotData& data, const FigurePlot& plot) {
  Range2 x = plot.x, y = plot.y;
  if (plot.logarithmic_x && !is_given(x)) x = decades(data, plot, &CurvePoint::x, 0);
  if (plot.logarithmic_y && !is_given(y)) y = decades(data, plot, &CurvePoint::y, 0.2);
  if (!has_numbers(data, plot)) {
    if (!is_given(x)) x = {0, 1};
    if (!is_given(y)) y = {0, 1};
  }
  std::string text = fmt::format("set xlabel {}\n", gnuplot_quoted(plot.x_label));
  if (!plot.title.empty()) text += fmt::format("set title {}\n", gnuplot_quoted(plot.title));
  const bool logarithmic = plot.logarithmic_x || plot.logarithmic_y;
  text += fmt::format("set xrange {}\nset yrange {}\nset offsets 0, 0, {}, 0\n", range(x), range(y),
                      logarithmic ? "0" : "graph 0.05");
  const bool has_segments = std::any_of(plot.curves.begin(), plot.curves.end(),
                                        [](const FigureCurve& curve) { return curve.style == Style::segments; });
  if (has_segments) text += "set palette defined (0 '#c6dbef', 1 '#0072b2', 2 '#08306b')\nunset colorbox\n";
  if (plot.equal_scales) text += "set size ratio -1\nset offsets 0, 0, 0, 0\n";
  if (plot.logarithmic_x) text += "set logscale x\nset format x '10^{%T}'\n";
  if (plot.logarithmic_y) text += "set logscale y\nset format y '10^{%T}'\n";
  return text;
}

std::string plot_command(const PlotData& data, const FigurePlot& plot, const std::string& name) {
  if (!has_numbers(data, plot)) {
    return "set label 9 'no number to draw here' at graph 0.5, graph 0.5 center\nplot NaN notitle\nunset label 9\n";
  }
  std::string command = "plot ", separator;
  const std::vector<std::string> colours = curve_colours(plot);
  Used used;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const FigureCurve& curve = plot.curves[i];
    if (!has_numbers(data, plot, curve)) continue;
    const std::string title = curve.legend.empty() ? "notitle" : "title " + gnuplot_quoted(curve.legend);
    const std::string every = curve.every > 1 ? fmt::format("every {} ", curve.every) : "";
    command += fmt::format("{}{}{} {}using {} {} {}", separator, name, i, every, columns_text(curve.style),
                           style_text(curve.style, colours[i], used), title);
    separator = ", \\\n  ";
    used.add(curve.style);
    if (curve.style == Style::sticks) {
      command +=
          fmt::format("{}{}{} using 1:2 with points pt 7 ps 0.5 lc rgb '{}' notitle", separator, name, i, colours[i]);
    }
  }
  return command + "\n";
}

}  // namespace clatter::validation::inline figures
