// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/simulate/simulation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "numeric/motion/free_flight.hpp"
#include "validation/run/scene_value.hpp"

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

/// The samples that a picture shows, and its range of times.
struct ShownHistory {
  std::vector<std::vector<double>> rows;
  Range2 time;
};

/// Without a window the first contact is not on the frame.
ShownHistory shown_history(const PictureHistory& history, const TimeWindow& window) {
  const double end = history.rows().back()[0];
  if (window.is_all()) return {history.rows(), {-0.015 * end, end}};
  return {clipped(history.rows(), window), {window.from, window.to}};
}

PicturePanel history_panel(const ShownHistory& history, const std::string& label, std::vector<FigureCurve> curves) {
  return {.columns = history_columns(),
          .rows = history.rows,
          .plot = {.y_label = label, .curves = std::move(curves), .x = history.time}};
}

/// The impacts of a sweep's picture: as many as each panel has colours for.
std::size_t drawn_impacts(const std::vector<SweptRun>& runs) {
  constexpr std::size_t most = 6;
  std::size_t impacts = 1;
  for (const SweptRun& swept : runs) impacts = std::max(impacts, swept.planned.run.impacts.size());
  return std::min(impacts, most);
}

/// At least one per cent of the energy to both sides, so that what is lost to rounding alone looks like nothing.
Range2 loss_range(const std::vector<SweptRun>& runs) {
  double energy = 0, loss = 0;
  for (const SweptRun& swept : runs) {
    const std::vector<numeric::ImpactRecord>& impacts = swept.planned.run.impacts;
    if (!impacts.empty()) energy = std::max(energy, swept.planned.run.energy_start);
    for (std::size_t i = 0; i < std::min(impacts.size(), drawn_impacts(runs)); ++i)
      loss = std::max(loss, std::fabs(impacts[i].value.energy_loss));
  }
  return loss < 0.01 * energy ? Range2{-0.01 * energy, 0.01 * energy} : Range2{};
}

/// What a sweep's picture shows of an impact.
struct SweptQuantity {
  const char *column, *unit, *label, *legend;
  double (*get)(const numeric::ImpactNumbers&);
};
using numeric::ImpactNumbers;
constexpr SweptQuantity swept_quantities[]{
    {"Vz", "m/s", "velocity [m/s]", "normal velocity after the impact, Vₙ",
     [](const ImpactNumbers& n) { return n.velocity_after.z(); }},
    {"Omega", "rad/s", "Ω [rad/s]", "angular velocity after the impact, Ω",
     [](const ImpactNumbers& n) { return n.angular_velocity_after.y(); }},
    {"P", "N·s", "impulse [N·s]", "normal impulse, Pₙ", [](const ImpactNumbers& n) { return n.impulse.z(); }},
    {"loss", "J", "energy [J]", "energy lost", [](const ImpactNumbers& n) { return n.energy_loss; }}};

/// A curve for each impact over the swept values.
PicturePanel swept_panel(const Scene& scene, const std::vector<SweptRun>& runs, const SweptQuantity& quantity) {
  const std::size_t impacts = drawn_impacts(runs);
  PicturePanel panel{
      .columns = {{"value", swept_column(*scene.sweep).unit.empty() ? "1" : "°", swept_words(*scene.sweep)}},
      .plot = {.y_label = quantity.label, .x = swept_range(scene.sweep->from, scene.sweep->to)}};
  for (std::size_t i = 0; i < impacts; ++i) {
    const std::string of_impact = impacts == 1 ? "" : fmt::format(", impact {}", i + 1);
    const std::string column = fmt::format("{}{}", quantity.column, i + 1);
    panel.columns.push_back({column, quantity.unit, quantity.legend + of_impact});
    panel.plot.curves.push_back({.x = "value",
                                 .y = column,
                                 .legend = i == 0 || impacts == 1 ? quantity.legend + of_impact : of_impact.substr(2),
                                 .style = Style::line_points});
  }
  for (const SweptRun& swept : runs) {
    auto& row = panel.rows.emplace_back(std::vector<double>{swept.value});
    for (std::size_t i = 0; i < impacts; ++i) {
      const auto& records = swept.planned.run.impacts;
      row.push_back(i < records.size() ? quantity.get(records[i].value) : no_number);
    }
  }
  return panel;
}

}  // namespace

void PictureHistory::add(const numeric::HistorySample& s) {
  if (s.time < 0) return;
  rows_.push_back({s.time, s.state.centre.z(), lowest_height(body_, s.state), s.force.z(), s.energy_translation,
                   s.energy_rotation, s.energy_potential, s.energy_ground, s.energy_total()});
}

namespace {

/// From when to when blows follow each other so fast that the whole picture shows them as one spike: the first such
/// group of impacts, with its numbers.
struct FastBlows {
  std::size_t first = 0, last = 0;  ///< of the impacts, from 0; the same: none
  double from = 0, to = 0;          ///< [s]
};

FastBlows fast_blows(const std::vector<std::vector<double>>& rows) {
  constexpr std::size_t time = 0, force = 3;
  constexpr double told_apart = 1. / 40;  // of the picture's width
  std::vector<std::pair<double, double>> contacts;
  bool touching = false;
  for (const std::vector<double>& row : rows) {
    const bool touches = row[force] > 0;
    if (touches && !touching) contacts.emplace_back(row[time], row[time]);
    if (touches) contacts.back().second = row[time];
    touching = touches;
  }
  const double near = told_apart * rows.back()[time];
  for (std::size_t i = 0; i + 1 < contacts.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < contacts.size() && contacts[last + 1].first - contacts[last].first < near) ++last;
    if (last > i) return {i, last, contacts[i].first, contacts[last].second};
  }
  return {};
}

/// Their force once more, over these times alone.
PicturePanel panel_of_fast_blows(const PictureHistory& kept, const FastBlows& blows) {
  const double margin = 0.1 * (blows.to - blows.from);
  const TimeWindow window{blows.from - margin, blows.to + margin};
  PicturePanel panel = history_panel(shown_history(kept, window), "force [N]", {over_time("force", "")});
  panel.plot.curves[0].legend =
      fmt::format("normal contact force of impacts {} to {}", blows.first + 1, blows.last + 1);
  panel.plot.curves[0].colour = palette::continuous;
  panel.plot.y = {0, no_number};
  panel.plot.x_label = "time since the first touch-down [s]";
  return panel;
}

}  // namespace

Picture simulation_picture(const Scene& scene, const PictureHistory& kept, const TimeWindow& window) {
  const ShownHistory history = shown_history(kept, window);
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
  picture.panels[1].plot.curves[0].colour = palette::continuous;
  const char* const energies[]{palette::translation, palette::rotation, palette::potential, palette::ground,
                               palette::ink};
  for (std::size_t i = 0; i < std::size(energies); ++i) picture.panels[2].plot.curves[i].colour = energies[i];
  picture.panels.back().plot.x_label = "time since the first touch-down [s]";
  const FastBlows blows = window.is_all() ? fast_blows(kept.rows()) : FastBlows{};
  if (blows.last > blows.first) picture.panels.push_back(panel_of_fast_blows(kept, blows));
  return picture;
}

Picture sweep_picture(const Scene& scene, const std::vector<SweptRun>& runs) {
  Picture picture{.what = drawn_impacts(runs) == 1 ? "First impact, continuous contact" : "Impacts, continuous contact",
                  .scene = scene.summary()};
  for (const SweptQuantity& quantity : swept_quantities) picture.panels.push_back(swept_panel(scene, runs, quantity));
  picture.panels.back().plot.y = loss_range(runs);
  const std::string unit = swept_column(*scene.sweep).unit;
  picture.panels.back().plot.x_label = swept_words(*scene.sweep) + (unit.empty() ? "" : " [" + unit + "]");
  return picture;
}

}  // namespace clatter::validation
