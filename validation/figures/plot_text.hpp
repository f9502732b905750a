// SPDX-License-Identifier: GPL-3.0-or-later
// A plot in gnuplot's language: axes, data blocks and the plot command.
#pragma once

#include <string>
#include <vector>

#include "validation/figures/figure.hpp"

namespace clatter::validation::inline figures {

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

}  // namespace clatter::validation::inline figures
