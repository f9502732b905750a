// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's figures as data: columns, rows, and which of them to draw against which.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/compare/case_runs.hpp"
#include "validation/output/palette.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

/// In place of a number that a row or a range does not have: nothing is drawn there.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct FigureColumn {
  std::string name;      ///< of the CSV
  std::string unit;      ///< "1" for none
  std::string quantity;  ///< what it is, one line
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
  std::string x, y;         ///< names of columns
  std::string legend = {};  ///< empty: not in the legend
  Style style = Style::line;
  RowFilter where = {};
  std::string y_low = {};              ///< name of a column; of areas only
  std::string x_end = {}, y_end = {};  ///< names of columns; of segments only
  std::string colour = {};             ///< empty: the next of the palette; no area has one
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

struct Figure {
  int number = 0;  ///< of the paper
  std::string title;
  std::string scene;  ///< what was dropped how, or the scene file
  std::vector<FigureColumn> columns;
  std::vector<std::vector<double>> rows = {};  ///< NaN: no value
  std::vector<FigurePlot> plots = {};

  /// "WORDS [UNIT]", the unit that of a column, with its symbol.
  [[nodiscard]] std::string label(const std::string& words, const std::string& column) const;
  /// "clatter figures --only N --output DIR".
  [[nodiscard]] std::string command() const;
};

/// 7 to 12, 14 to 17, 19 to 24.
[[nodiscard]] const std::vector<int>& figure_numbers();
/// @throws std::out_of_range for a number that is not among them.
[[nodiscard]] Figure make_figure(int number, CaseRuns& case_runs);

/// All that a panel shows and how, by the names of FigurePlot's and FigureCurve's members; what is empty or as usual is
/// left out.
[[nodiscard]] Value plot_fields(const FigurePlot& plot);

/// Its title, scene and command, and its rows; CSV explains each column, and says in a line "plot: JSON" how each panel
/// is drawn, as JSON does in the list "plots".
[[nodiscard]] Report figure_report(const Figure& figure);

// The figures one by one; make_figure() chooses.

/// Positions of the rod in its first flight (Fig. 8).
[[nodiscard]] Figure figure_rod_positions();

/// β(θ) (Fig. 7); P₁, P₂ (Fig. 9); β, γ (Fig. 10); the same with gravity (Figs. 11, 12).
[[nodiscard]] Figure figure_second_angle();
[[nodiscard]] Figure figure_two_impulses();
[[nodiscard]] Figure figure_both_angles();
[[nodiscard]] Figure figure_angles_with_gravity();
[[nodiscard]] Figure figure_impulses_with_gravity();

/// The rod over the angle (Fig. 14) and over friction (Fig. 15), the course of its first contact (Fig. 16), several
/// impacts (Fig. 17).
[[nodiscard]] Figure figure_rod_over_angle(CaseRuns& case_runs);
[[nodiscard]] Figure figure_rod_over_friction(CaseRuns& case_runs);
[[nodiscard]] Figure figure_rod_contact(CaseRuns& case_runs);
[[nodiscard]] Figure figure_rod_sequence(CaseRuns& case_runs);

/// The elastic phone (Figs. 19, 20), the damped one (Figs. 21 to 23), the damped one over the angle (Fig. 24).
[[nodiscard]] Figure figure_phone_history(CaseRuns& case_runs, bool damped);
[[nodiscard]] Figure figure_phone_impacts(CaseRuns& case_runs, bool damped);
[[nodiscard]] Figure figure_phone_energies(CaseRuns& case_runs);
[[nodiscard]] Figure figure_phone_over_angle(CaseRuns& case_runs);

// Figures as files.

/// Creates the folder if it is not there.  @throws BadInput if it cannot be, or is a file.
void make_folder(const std::string& folder, const std::string& option);

/// Where figures go, and in what form.
struct FigureFiles {
  std::string folder;
  TextStyle style;

  /// FOLDER/figure_07.csv, or .txt, .json, .md, .tex.
  [[nodiscard]] std::string path(int number) const;
};

/// @throws BadInput if a file of these figures cannot be written, or two of them are one by links.
void check_figure_files(const std::vector<int>& numbers, const FigureFiles& files);

/// Writes the figure's file, whole or not at all.  @throws BadInput naming the file if it cannot be written.
void write_figure(const Figure& figure, const FigureFiles& files);

}  // namespace clatter::validation
