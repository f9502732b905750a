// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's figures as data: columns, rows, and which of them to draw against which.
#pragma once

#include <string>
#include <vector>

#include "validation/compare/case_runs.hpp"
#include "validation/output/plot.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

struct Figure {
  int number = 0;  ///< of the paper
  std::string title{};
  std::string scene{};    ///< what was dropped how, or the scene file
  std::string changed{};  ///< parameters in place of the paper's, in words; empty: none
  std::vector<FigureColumn> columns{};
  std::vector<std::vector<double>> rows = {};  ///< NaN: no value
  std::vector<FigurePlot> plots = {};

  /// "WORDS [UNIT]", the unit that of a column, with its symbol.
  [[nodiscard]] std::string label(const std::string& words, const std::string& column) const;
  /// "clatter verify --figures --only N --output DIR", which makes the paper's.
  [[nodiscard]] std::string command() const;
};

/// Numbers in place of the paper's.  Figs. 14 to 24 take those of their scenes from the CaseRuns they are made with.
struct FigureParameters {
  std::vector<double> angles_deg{};       ///< of the rods of Fig. 8, above 0 and below 90 [°]; empty: the paper's
  std::vector<double> gravity_numbers{};  ///< of Figs. 7 and 9 to 12, at least 0, one to three; empty: the paper's
};

/// 7 to 12, 14 to 17, 19 to 24.
[[nodiscard]] const std::vector<int>& figure_numbers();
/// @throws std::out_of_range for a number that is not among them; BadInput for parameters that the figure does not
/// have,
///         or a drop that has too few impacts for it.
[[nodiscard]] Figure make_figure(int number, CaseRuns& case_runs, const FigureParameters& parameters = {});

/// Its title, scene and command, and its rows; CSV explains each column, and says in a line "plot: JSON" how each panel
/// is drawn, as JSON does in the list "plots".
[[nodiscard]] Report figure_report(const Figure& figure);

// The figures one by one; make_figure() chooses.

/// Positions of the rod in its first flight (Fig. 8).
[[nodiscard]] Figure figure_rod_positions(const std::vector<double>& angles_deg);

/// β(θ) (Fig. 7); P₁, P₂ (Fig. 9); β, γ (Fig. 10); the same with gravity (Figs. 11, 12).
[[nodiscard]] Figure figure_second_angle(const std::vector<double>& gravity_numbers);
[[nodiscard]] Figure figure_two_impulses(const std::vector<double>& gravity_numbers);
[[nodiscard]] Figure figure_both_angles(const std::vector<double>& gravity_numbers);
[[nodiscard]] Figure figure_angles_with_gravity(const std::vector<double>& gravity_numbers);
[[nodiscard]] Figure figure_impulses_with_gravity(const std::vector<double>& gravity_numbers);

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

// The paper's figures as SVG, drawn by gnuplot.

/// One SVG element per plot of the figure, a zoom after its plot, ready to stand in an HTML page.
/// @throws as run_gnuplot.
[[nodiscard]] std::vector<std::string> draw(const Figure& figure);

// What the figures of forces and energies over time share.

/// A column, its name in the legend and its colour.
struct EnergyCurve {
  const char *column, *legend, *colour;
};

/// `axes` with these energies of the figure over its column "time", from 0 on.
[[nodiscard]] FigurePlot energy_panel(FigurePlot axes, const std::vector<EnergyCurve>& energies,
                                      const RowFilter& where = {});

/// Adds columns for time, normal force and energies: total, kinetic, potential.
void add_history_columns(Figure& figure);
/// Adds a row: `front`, then the values of those columns.
void add_history_row(Figure& figure, std::vector<double> front, const numeric::HistorySample& sample);
/// Adds two panels, force and energies over all the times.
/// @param caption  behind the titles "(a)" and "(b)"
/// @param force_legend  name of the force's curve
void add_history_panels(Figure& figure, const std::string& caption, const std::string& force_legend,
                        const RowFilter& where = {});

}  // namespace clatter::validation
