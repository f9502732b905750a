// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures of forces and energies over time share.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "validation/evidence/figure.hpp"

namespace clatter::validation {

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
