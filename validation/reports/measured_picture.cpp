// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/version.hpp"
#include "validation/reports/measured_report.hpp"

namespace clatter::validation::inline reports {
namespace {

constexpr int points_of_a_flight = 40;
constexpr double predicted = 1, measured = 0;

const ScoredDrop& chosen_drop(const Scores& scores, const std::string& name) {
  const auto found = std::find_if(scores.drops.begin(), scores.drops.end(), [&](const ScoredDrop& drop) {
    return name.empty() ? drop.measured.is_point : drop.name == name;
  });
  if (found != scores.drops.end()) return *found;
  throw BadInput(name.empty() ? "--plot: no point impact was scored"
                              : fmt::format("--drop {}: not among those scored", name));
}

PicturePanel track_panel(const MeasuredRun& run, const ScoredDrop& drop) {
  const ForecastModel model = forecast_model(run.file, run.fit);
  PicturePanel panel{
      .columns = {{"time", "s", "since impact 1"},
                  {"height", "m", "of the centre"},
                  {"kind", "1", "0 measured, 1 predicted"}},
      .rows = {},
      .plot = {
          .title = "",
          .x_label = "t [s]",
          .y_label = "height of the centre [m]",
          .curves = {
              {.x = "time",
               .y = "height",
               .legend = "drop " + drop.name + ", measured",
               .style = FigureCurve::Style::points,
               .where = {{"kind", measured}}},
              {.x = "time", .y = "height", .legend = "predicted from impact 1 on", .where = {{"kind", predicted}}}}}};
  const auto track = std::find_if(run.file.file.tracks.begin(), run.file.file.tracks.end(),
                                  [&](const Track& t) { return t.name == drop.name; });
  const double ground = run.fit.calibration.calibration.ground;
  double last = 0;
  for (const Frame& frame : track->frames) {
    last = frame.time - drop.measured.time;
    panel.rows.push_back({last, frame.position.z() - ground, measured});
  }
  for (const HeightAt& at : predicted_heights(model, drop.measured, last, points_of_a_flight))
    panel.rows.push_back({at.time, at.height, predicted});
  return panel;
}

PicturePanel residual_panel(const Scores& scores) {
  PicturePanel panel{.columns = {{"angle", "deg", "between the corner's arm and the vertical"},
                                 {"error", "%", "of the motion after impact 1"},
                                 {"point", "1", "1: a point impact"}},
                     .rows = {},
                     .plot = {.title = "",
                              .x_label = "angle between the corner's arm and the vertical [°]",
                              .y_label = "error [%]",
                              .curves = {{.x = "angle",
                                          .y = "error",
                                          .legend = "point impacts",
                                          .style = FigureCurve::Style::points,
                                          .where = {{"point", 1.0}}},
                                         {.x = "angle",
                                          .y = "error",
                                          .legend = "others",
                                          .style = FigureCurve::Style::points,
                                          .where = {{"point", 0.0}}}}}};
  for (const ScoredDrop& drop : scores.drops)
    panel.rows.push_back({drop.measured.angle_degrees(), 100 * drop.error, drop.measured.is_point ? 1.0 : 0.0});
  return panel;
}

PicturePanel coverage_panel(const MeasuredRun& run, const Scores& scores) {
  PicturePanel panel{
      .columns = {{"width", "1", "over that of the 90 % interval"}, {"share", "%", "of the numbers within"}},
      .rows = {},
      .plot = {.title = "",
               .x_label = "distance over half the 90 % interval",
               .y_label = "numbers within [%]",
               .curves = {{.x = "width", .y = "share", .legend = "velocities after impact 1; 90 % belong at 1"}}}};
  const TrackedBody body(run.file.file.description, run.fit.calibration.calibration);
  std::vector<double> ratios;
  for (const ScoredDrop& drop : scores.drops) {
    if (!drop.measured.is_point) continue;
    const MotionParts off = motion_parts(body, drop.measured.after.state) - motion_parts(body, drop.predicted.after);
    for (const int part : active_parts(run.file.file.description))
      ratios.push_back(std::fabs(off[part]) / drop.predicted.half_width[part]);
  }
  std::sort(ratios.begin(), ratios.end());
  for (std::size_t i = 0; i < ratios.size(); ++i)
    panel.rows.push_back({ratios[i], 100 * static_cast<double>(i + 1) / static_cast<double>(ratios.size())});
  return panel;
}

}  // namespace

Picture measured_picture(const MeasuredRun& run, const Scores& scores, const std::string& drop) {
  return {.what = "Predictions held against measured drops",
          .scene = {run.file.file.description.source, run.split_words},
          .panels = {track_panel(run, chosen_drop(scores, drop)), residual_panel(scores), coverage_panel(run, scores)}};
}

std::vector<std::string> measured_words(const MeasuredRun& run) {
  return {fmt::format("clatter {}, measured: {}", version, run.file.file.path), run.split_words,
          run.file.file.description.source};
}

}  // namespace clatter::validation::inline reports
