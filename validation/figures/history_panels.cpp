#include "validation/figures/history_panels.hpp"

#include <limits>

namespace clatter::validation {

FigurePlot energy_panel(FigurePlot axes, const std::vector<EnergyCurve>& energies, const RowFilter& where) {
  axes.y_label = "energy [J]";
  axes.y = {0, std::numeric_limits<double>::quiet_NaN()};
  for (const auto& [column, legend] : energies) {
    axes.curves.push_back({.x = "time", .y = column, .legend = legend, .where = where});
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

void add_history_panels(Figure& figure, const FigurePlot& axes, const RowFilter& where) {
  FigurePlot force = axes;
  force.y_label = "normal contact force [N]";
  force.curves = {{.x = "time", .y = "Fn", .legend = "", .where = where}};
  figure.plots.push_back(force);
  figure.plots.push_back(
      energy_panel(axes, {{"E", "total"}, {"E_kinetic", "kinetic"}, {"E_potential", "potential"}}, where));
}

}  // namespace clatter::validation
