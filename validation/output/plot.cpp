// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/plot.hpp"

#include <iterator>
#include <stdexcept>

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

}  // namespace clatter::validation
