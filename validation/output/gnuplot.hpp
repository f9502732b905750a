// SPDX-License-Identifier: GPL-3.0-or-later
// gnuplot, as a program that this one starts.
#pragma once

#include <string>
#include <vector>

#include "validation/output/plot.hpp"

namespace clatter::validation {

/// Runs a script with gnuplot's default settings; returns what it writes to its standard output.
/// @throws BadInput if gnuplot is not there; std::runtime_error with its first line of complaint if it fails, or if no
/// temporary file can be made.
[[nodiscard]] std::string run_gnuplot(const std::string& script);
/// The same with binary data in a temporary file, whose name the script has as the variable `data`.
[[nodiscard]] std::string run_gnuplot(const std::string& script, const std::string& data);

/// @param purpose what needs it, such as "--plot FILE", for the message
/// @param terminal that gnuplot must have
/// @throws as run_gnuplot.
void require_gnuplot(const std::string& purpose, const std::string& terminal = "svg");

/// A text as gnuplot's string constant, in which nothing is replaced and no line of foreign text is a command.
[[nodiscard]] std::string gnuplot_quoted(const std::string& text);

// A plot in gnuplot's language: axes, data blocks and the plot command.

/// What a plot takes its curves from.
struct PlotData {
  const std::vector<FigureColumn>& columns;
  const std::vector<std::vector<double>>& rows;
};

/// The curves as data blocks with these names: "NAME0", "NAME1", ….  Each begins with a comment that says what its
/// columns are; a curve without a number has none.  Rows without a number are empty lines; on a logarithmic axis so are
/// those that are not positive.
[[nodiscard]] std::string data_blocks(const PlotData& data, const FigurePlot& plot, const std::string& name);

/// Title, name of the x axis, ranges and kinds of the axes.
[[nodiscard]] std::string axes_text(const PlotData& data, const FigurePlot& plot);

/// Points take the colour of the line before them if they have no name of their own.  Without any number to draw, the
/// plot says so.
[[nodiscard]] std::string plot_command(const PlotData& data, const FigurePlot& plot, const std::string& name);

}  // namespace clatter::validation
