// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a run: panels over one another, as a gnuplot script.
#pragma once

#include <string>
#include <vector>

#include "validation/output/plot.hpp"

namespace clatter::validation {

/// One plot with the numbers that it shows.
struct PicturePanel {
  std::vector<FigureColumn> columns;
  std::vector<std::vector<double>> rows;  ///< NaN: no value
  FigurePlot plot;                        ///< no x label: the axis is that of the panel below
};

struct Picture {
  std::string what;                ///< the first line of the title
  std::vector<std::string> scene;  ///< body, drop, ground: put together to as few lines below it as they fill
  std::vector<PicturePanel> panels;
};

/// The look of axes in gnuplot's language.
inline constexpr const char* axes_style =
    "set border 3 lc rgb '#444444'\nset tics nomirror\nset grid lc rgb '#dddddd' lt 1\n";

enum class PictureFormat { svg, png };

/// gnuplot's terminal for a format.
[[nodiscard]] const char* terminal_name(PictureFormat format);

/// All that draws the picture, its data included.
/// @param output file that the script writes; empty: to standard output, byte for byte the same.
[[nodiscard]] std::string picture_script(const Picture& picture, PictureFormat format, const std::string& output);

}  // namespace clatter::validation
