#include "validation/reports/simulation_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numeric/motion/free_flight.hpp"
#include "validation/reports/swept_column.hpp"

namespace clatter::validation {
namespace {

using Style = FigureCurve::Style;

/// In the order of PictureHistory's rows.
const std::vector<FigureColumn>& history_columns() {
  static const std::vector<FigureColumn> columns{{"time", "s", "time since the first touch-down"},
                                                 {"centre", "m", "height of the mass centre"},
                                                 {"lowest", "m", "height of the lowest point"},
                                                 {"force", "N", "normal contact force"},
                                                 {"translation", "J", "kinetic energy of translation"},
                                                 {"rotation", "J", "kinetic energy of rotation"},
                                                 {"potential", "J", "potential energy"},
                                                 {"ground", "J", "energy stored in the ground"},
                                                 {"total", "J", "total energy"}};
  return columns;
}

FigureCurve over_time(const char* column, const char* legend) { return {.x = "time", .y = column, .legend = legend}; }

/// The first contact is not on the frame.
PicturePanel history_panel(const PictureHistory& history, const std::string& label, std::vector<FigureCurve> curves) {
  const double end = history.rows().back()[0];
  return {.columns = history_columns(),
          .rows = history.rows(),
          .plot = {.title = "",
                   .x_label = "",
                   .y_label = label,
                   .curves = std::move(curves),
                   .x = {-0.015 * end, end},
                   .y = {}}};
}

/// At least one per cent of the energy to both sides, so that what is lost to rounding alone looks like nothing.
Range2 loss_range(const std::vector<SweptRun>& runs) {
  double energy = 0, loss = 0;
  for (const SweptRun& swept : runs) {
    if (swept.planned.run.impacts.empty()) continue;
    energy = std::max(energy, swept.planned.run.energy_start);
    loss = std::max(loss, std::fabs(swept.planned.run.impacts[0].value.energy_loss));
  }
  return loss < 0.01 * energy ? Range2{-0.01 * energy, 0.01 * energy} : Range2{};
}

}  // namespace

void PictureHistory::record(const numeric::HistorySample& s) {
  if (s.time < 0) return;
  rows_.push_back({s.time, s.state.centre.z(), lowest_height(body_, s.state), s.force.z(), s.energy_translation,
                   s.energy_rotation, s.energy_potential, s.energy_ground, s.energy_total()});
}

Picture simulation_picture(const Scene& scene, const PictureHistory& history) {
  Picture picture{.what = "Impact sequence, continuous contact",
                  .scene = scene.summary(),
                  .panels = {history_panel(history, "height [m]",
                                           {over_time("centre", "mass centre"), over_time("lowest", "lowest point")}),
                             history_panel(history, "force [N]", {over_time("force", "normal contact force")}),
                             history_panel(history, "energy [J]",
                                           {over_time("translation", "translation"), over_time("rotation", "rotation"),
                                            over_time("potential", "potential"), over_time("ground", "ground"),
                                            over_time("total", "total")})}};
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) picture.panels[i].plot.y = {0, no_number};
  picture.panels.back().plot.x_label = "time since the first touch-down [s]";
  return picture;
}

Picture sweep_picture(const Scene& scene, const std::vector<SweptRun>& runs) {
  const SceneSweep& sweep = *scene.sweep;
  const std::vector<FigureColumn> columns{{"value", swept_column(sweep).unit.empty() ? "1" : "°", swept_words(sweep)},
                                          {"Vz", "m/s", "normal velocity of the mass centre after impact 1"},
                                          {"Omega", "rad/s", "angular velocity after impact 1"},
                                          {"P", "N·s", "normal impulse of impact 1"},
                                          {"loss", "J", "energy lost in impact 1"}};
  std::vector<std::vector<double>> rows;
  for (const SweptRun& swept : runs) {
    if (swept.planned.run.impacts.empty()) {
      rows.push_back({swept.value, no_number, no_number, no_number, no_number});
      continue;
    }
    const numeric::ImpactNumbers& first = swept.planned.run.impacts[0].value;
    rows.push_back({swept.value, first.velocity_after.z(), first.angular_velocity_after.y(), first.impulse.z(),
                    first.energy_loss});
  }
  Picture picture{.what = "First impact, continuous contact", .scene = scene.summary(), .panels = {}};
  struct Panel {
    const char *column, *label, *legend;
  };
  for (const auto& [column, label, legend] :
       {Panel{"Vz", "velocity [m/s]", "normal velocity after the impact, Vₙ"},
        Panel{"Omega", "Ω [rad/s]", "angular velocity after the impact, Ω"},
        Panel{"P", "impulse [N·s]", "normal impulse, Pₙ"}, Panel{"loss", "energy [J]", "energy lost"}}) {
    picture.panels.push_back(
        {.columns = columns,
         .rows = rows,
         .plot = {.title = "",
                  .x_label = "",
                  .y_label = label,
                  .curves = {{.x = "value", .y = column, .legend = legend, .style = Style::line_points}},
                  .x = swept_range(runs.front().value, runs.back().value),
                  .y = {}}});
  }
  picture.panels.back().plot.y = loss_range(runs);
  const std::string unit = swept_column(sweep).unit;
  picture.panels.back().plot.x_label = swept_words(sweep) + (unit.empty() ? "" : " [" + unit + "]");
  return picture;
}

}  // namespace clatter::validation
