// SPDX-License-Identifier: GPL-3.0-or-later
// A plot as data: columns, and which of them to draw against which.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/output/palette.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

/// In place of a number that a row or a range does not have: nothing is drawn there.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct FigureColumn {
  std::string name{};      ///< of the CSV
  std::string unit{};      ///< "1" for none
  std::string quantity{};  ///< what it is, one line
};

/// Only the rows in which each of these columns has its value; none: all.
using RowFilter = std::vector<std::pair<std::string, double>>;

/// Colours that colour-blind readers can tell apart, and ink.
inline constexpr const char *blue = palette::discrete, *red = palette::continuous, *green = palette::ground,
                            *pink = palette::gamma, *ink = palette::ink;

/// One line or set of points of a plot.
struct FigureCurve {
  /// marks: large points, each curve with a shape of its own; sticks: from zero up; area: between `y_low` and `y`;
  /// segments: each row from (x, y) to (x_end, y_end), from light to dark blue; regions: filled outlines, gaps between.
  enum class Style {
    line,
    dashed,
    dotted,
    points,
    squares,
    crosses,
    bars,
    line_points,
    marks,
    sticks,
    area,
    segments,
    regions
  };
  std::string x{}, y{};     ///< names of columns
  std::string legend = {};  ///< empty: not in the legend
  Style style = Style::line;
  RowFilter where = {};
  std::string y_low = {};              ///< name of a column; of areas only
  std::string x_end = {}, y_end = {};  ///< names of columns; of segments only
  std::string colour = {};             ///< empty: the next of the palette
  int every = 1;                       ///< of points: one for each that many rows
};

struct Range2 {
  double low = no_number;  ///< NaN: from the data
  double high = no_number;
};

/// A window in a panel that shows its curves over a part of the x axis.
struct FigureZoom {
  double left, bottom, width, height;  ///< in parts of the panel
  Range2 x = {};
  std::string title = {};
};

/// One panel, with the paper's axes.
struct FigurePlot {
  std::string title = {};
  std::string x_label = {}, y_label = {};  ///< symbol or words, and unit
  std::vector<FigureCurve> curves = {};
  Range2 x = {};
  Range2 y = {};
  double x_factor = 1;            ///< the x axis shows the columns' numbers times this
  std::string legend_place = {};  ///< "upper left", "lower left" or "beside"; empty: outside the axes
  std::optional<FigureZoom> zoom = {};
  bool logarithmic_x = false;
  bool logarithmic_y = false;
  bool whole_x = false;       ///< x counts something: no fractions on its axis
  bool whole_y = false;       ///< likewise y, over a few numbers alone
  bool equal_scales = false;  ///< a metre is as long on both axes
  bool no_axes = false;       ///< places on a map: their numbers mean nothing
  bool ring = false;          ///< directions around the origin in place of axes; with no_axes
};

/// The colour of each curve; "" for areas.
[[nodiscard]] std::vector<std::string> curve_colours(const FigurePlot& plot);

/// Index of the column of this name.  @throws std::out_of_range if there is none.
[[nodiscard]] std::size_t column_index(const std::vector<FigureColumn>& columns, const std::string& name);

/// All that a panel shows and how, by the names of FigurePlot's and FigureCurve's members; what is empty or as usual is
/// left out.
[[nodiscard]] Value plot_fields(const FigurePlot& plot);

}  // namespace clatter::validation
