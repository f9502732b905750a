// Figures as SVG, drawn by gnuplot.
#pragma once

#include <string>
#include <vector>

#include "validation/figures/figure.hpp"

namespace clatter::validation {

/// @throws std::runtime_error if gnuplot is not there or no temporary file can be made.
void require_gnuplot();

/// One SVG element per plot of the figure, ready to stand in an HTML page.
/// @throws std::runtime_error with gnuplot's first line of complaint if it is not there or fails.
[[nodiscard]] std::vector<std::string> draw(const Figure& figure);

}  // namespace clatter::validation
