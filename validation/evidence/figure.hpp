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

/// β(θ) (7); P₁, P₂ (9); β, γ (10); the same with gravity (11, 12).
[[nodiscard]] Figure figure_of_impacts(int number, const std::vector<double>& gravity_numbers);

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

// The paper's figures as SVG, drawn by gnuplot.

/// One SVG element per plot of the figure, a zoom after its plot, ready to stand in an HTML page.
/// @throws as run_gnuplot.
[[nodiscard]] std::vector<std::string> draw(const Figure& figure);

}  // namespace clatter::validation
