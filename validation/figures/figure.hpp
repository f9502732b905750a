// The paper's figures as data: columns, rows, and which of them to draw against which.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/compare/case_runs.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

/// In place of a number that a row or a range does not have: nothing is drawn there.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct FigureColumn {
  std::string name;      ///< of the CSV
  std::string unit;      ///< "1" for none
  std::string quantity;  ///< what it is, one line
};

/// Only the rows in which this column has this value; none: all.
using RowFilter = std::optional<std::pair<std::string, double>>;

/// One line or set of points of a plot.
struct FigureCurve {
  /// marks: large points, each curve with a shape of its own; sticks: from zero up; area: between `y_low` and `y`;
  /// segments: each row from (x, y) to (x_end, y_end).
  enum class Style { line, thin_line, points, bars, line_points, marks, sticks, area, segments };
  std::string x, y;  ///< names of columns
  std::string legend;
  Style style = Style::line;
  RowFilter where;
  std::string y_low = {};              ///< name of a column; of areas only
  std::string x_end = {}, y_end = {};  ///< names of columns; of segments only
};

struct Range2 {
  double low = std::numeric_limits<double>::quiet_NaN();  ///< NaN: from the data
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// One panel, with the paper's axes.
struct FigurePlot {
  std::string title;
  std::string x_label, y_label;
  std::vector<FigureCurve> curves;
  Range2 x = {};
  Range2 y = {};
  bool logarithmic_x = false;
  bool logarithmic_y = false;
  bool whole_x = false;       ///< x counts something: no fractions on its axis
  bool equal_scales = false;  ///< a metre is as long on both axes
};

/// Index of the column of this name.  @throws std::out_of_range if there is none.
[[nodiscard]] std::size_t column_index(const std::vector<FigureColumn>& columns, const std::string& name);

struct Figure {
  int number = 0;  ///< of the paper
  std::string title;
  std::string scene;  ///< what was dropped how, or the scene file
  std::vector<FigureColumn> columns;
  std::vector<std::vector<double>> rows;  ///< NaN: no value
  std::vector<FigurePlot> plots;

  /// "clatter figures --only N --output DIR".
  [[nodiscard]] std::string command() const;
};

/// 7 to 12, 14 to 17, 19 to 24.
[[nodiscard]] const std::vector<int>& figure_numbers();
/// @throws std::out_of_range for a number that is not among them.
[[nodiscard]] Figure make_figure(int number, CaseRuns& case_runs);

/// Its title, scene and command, and its rows; CSV explains each column.
[[nodiscard]] Report figure_report(const Figure& figure);

}  // namespace clatter::validation
