// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/tradeoff_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "validation/output/number.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

const char* const tradeoff_summary = "cost against true error";

std::string setting_words(const TradePoint& point) {
  if (point.tolerance > 0) return significant(point.tolerance, 1);
  if (point.step > 0) return fmt::format("{} s", significant(point.step, 2));
  return "";
}

std::string name_of(const TradePoint& point) {
  return point.method.empty() ? level_name(point.level) : fmt::format("{} {}", level_name(point.level), point.method);
}

/// Where the planar level applies, the spatial one is the same but for rounding, and one set of points.
std::string curve_of(const Tradeoff& tradeoff, const TradePoint& point) {
  const bool is_twofold = point.level == ModelLevel::spatial &&
                          std::any_of(tradeoff.points.begin(), tradeoff.points.end(), [](const TradePoint& other) {
                            return other.level == ModelLevel::planar && other.failure.empty();
                          });
  return is_twofold ? "spatial, all methods" : name_of(point);
}

/// The points of the front, the cheapest first.
std::vector<const TradePoint*> front_of(const Tradeoff& tradeoff) {
  std::vector<const TradePoint*> front;
  for (const TradePoint& point : tradeoff.points) {
    if (point.pareto) front.push_back(&point);
  }
  std::sort(front.begin(), front.end(),
            [](const TradePoint* a, const TradePoint* b) { return a->seconds < b->seconds; });
  return front;
}

Row point_row(const TradePoint& point) {
  const auto positive = [](double number, int digits) { return number > 0 ? Cell(number, digits) : Cell(); };
  return {Cell(level_name(point.level)),
          Cell(text_or_nothing(point.method)),
          positive(point.tolerance, 1),
          positive(point.step, 2),
          Cell(text_or_nothing(point.mesh)),
          point.failure.empty() ? Cell(point.seconds, 2) : Cell(),
          Cell(point.repeats),
          Cell(point.evaluations, point.evaluations > 0 ? std::to_string(point.evaluations) : ""),
          Cell(point.error, 2),
          Cell(point.pareto),
          Cell(text_or_nothing(point.failure))};
}

std::string reference_words(const Tradeoff& tradeoff) {
  return fmt::format("error: largest over {} impacts, relative to the sequence's sizes; true values: {}, known to {}",
                     tradeoff.impacts, tradeoff.reference, significant(tradeoff.reference_error, 1));
}

}  // namespace

std::vector<Column> tradeoff_columns() {
  return {word_column("model", "model", "a model of the hierarchy"),
          word_column("method", "method", "of integration"),
          {"tolerance", "tol.", "", "of the method, per step"},
          {"step", "step", "s", "of a method of fixed steps"},
          word_column("mesh", "mesh", "another mesh than the scene's"),
          {"seconds", "cost", "s", "least wall time of a run"},
          {"repeats", "", "", "runs whose time was taken", false},
          {"force_evaluations", "evaluations", "", "that a run takes"},
          {"error", "error", "", "largest over all impacts and numbers, relative to the sequence's sizes"},
          {"front", "", "", "whether no point beats it in both cost and error", false},
          {"failure", "", "", "why it has no numbers", false}};
}

Report tradeoff_report(const Scene& scene, const Tradeoff& tradeoff) {
  Report report = begun_report("tradeoff", tradeoff_summary);
  report.head = scene_head(scene);
  report.grid.columns = tradeoff_columns();
  for (const TradePoint& point : tradeoff.points) report.grid.rows.push_back(point_row(point));
  report.digest = Grid{tradeoff_columns(), {}};
  for (const TradePoint* point : front_of(tradeoff)) report.digest->rows.push_back(point_row(*point));
  report.notes = {
      fmt::format("The front: of {} points, those that none beats in both cost and error.", tradeoff.points.size()),
      reference_words(tradeoff)};
  for (const TradePoint& point : tradeoff.points) {
    if (point.failure.empty()) continue;
    const std::string setting = setting_words(point);
    report.notes.push_back(
        fmt::format("failed: {}{}{}: {}", name_of(point), setting.empty() ? "" : ", ", setting, point.failure));
  }
  report.fields["model"] = "tradeoff";
  report.fields["scene"] = scene_value(scene);
  report.fields["body"] = body_value(scene);
  report.fields["points"] = row_objects(report.grid);
  report.fields["reference"] = tradeoff.reference;
  report.fields["reference_error"] = rounded_up(tradeoff.reference_error);
  report.fields["impacts"] = tradeoff.impacts;
  report.fields["shortfall"] = text_or_nothing(tradeoff.shortfall);
  report.fields["message"] = reference_words(tradeoff);
  return report;
}

Picture tradeoff_picture(const Scene& scene, const Tradeoff& tradeoff) {
  PicturePanel panel{.columns = {{"curve", "1", "number of the model and method"},
                                 {"cost", "ms", "least wall time"},
                                 {"error", "1", "true error"}},
                     .rows = {},
                     .plot = {.title = "",
                              .x_label = "cost [ms]",
                              .y_label = "largest true error, relative",
                              .curves = {},
                              .x = {},
                              .y = {},
                              .logarithmic_x = true,
                              .logarithmic_y = true}};
  std::map<std::string, double> curves;
  double cheapest = std::numeric_limits<double>::infinity(), dearest = 0;
  for (const TradePoint& point : tradeoff.points) {
    if (!point.failure.empty() || !point.mesh.empty() || !(point.error > 0)) continue;
    const std::string name = curve_of(tradeoff, point);
    const auto [place, is_new] = curves.try_emplace(name, static_cast<double>(curves.size()));
    panel.rows.push_back({place->second, 1e3 * point.seconds, point.error});
    cheapest = std::min(cheapest, 1e3 * point.seconds);
    dearest = std::max(dearest, 1e3 * point.seconds);
    if (!is_new) continue;
    const auto style = point.method.empty()             ? FigureCurve::Style::marks
                       : name == "spatial, all methods" ? FigureCurve::Style::points
                                                        : FigureCurve::Style::line_points;
    panel.plot.curves.push_back(
        {.x = "cost", .y = "error", .legend = name, .style = style, .where = {{"curve", place->second}}});
  }
  panel.plot.x = {cheapest / 3, 3 * dearest};  // a point on the frame is hard to see
  return {
      .what = "Cost against true error of models, methods and tolerances", .scene = scene.summary(), .panels = {panel}};
}

}  // namespace clatter::validation
