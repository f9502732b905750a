// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/history_panels.hpp"

namespace clatter::validation {

FigurePlot energy_panel(FigurePlot axes, const std::vector<EnergyCurve>& energies, const RowFilter& where) {
  axes.y_label = "energy [J]";
  axes.y = {0, no_number};
  for (const auto& [column, legend, colour] : energies) {
    axes.curves.push_back({.x = "time", .y = column, .legend = legend, .where = where, .colour = colour});
  }
  return axes;
}

void add_history_columns(Figure& figure) {
  figure.columns.insert(figure.columns.end(), {{"time", "s", "since the first touch-down"},
                                               {"Fn", "N", "normal contact force"},
                                               {"E", "J", "total energy"},
                                               {"E_kinetic", "J", "kinetic energy"},
                                               {"E_potential", "J", "potential energy"}});
}

void add_history_row(Figure& figure, std::vector<double> front, const numeric::HistorySample& s) {
  front.insert(front.end(),
               {s.time, s.force.z(), s.energy_total(), s.energy_translation + s.energy_rotation, s.energy_potential});
  figure.rows.push_back(std::move(front));
}

void add_history_panels(Figure& figure, const std::string& caption, const std::string& force_legend,
                        const RowFilter& where) {
  const std::string time = figure.label("time", "time");
  figure.plots.push_back(
      {.title = "(a)" + caption,
       .x_label = time,
       .y_label = figure.label("normal contact force Fₙ", "Fn"),
       .curves = {{.x = "time", .y = "Fn", .legend = force_legend, .where = where, .colour = palette::continuous}},
       .y = {0, no_number}});
  figure.plots.push_back(energy_panel({.title = "(b)" + caption, .x_label = time},
                                      {{"E", "total", ink},
                                       {"E_kinetic", "kinetic", palette::translation},
                                       {"E_potential", "potential", palette::potential}},
                                      where));
}

}  // namespace clatter::validation
