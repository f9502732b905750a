// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's figures as SVG, drawn by gnuplot.
#pragma once

#include <string>
#include <vector>

#include "validation/figures/figure.hpp"

namespace clatter::validation::inline figures {

/// One SVG element per plot of the figure, a zoom after its plot, ready to stand in an HTML page.
/// @throws as run_gnuplot.
[[nodiscard]] std::vector<std::string> draw(const Figure& figure);

}  // namespace clatter::validation::inline figures
