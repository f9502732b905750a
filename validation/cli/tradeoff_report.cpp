#include "validation/cli/tradeoff_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "validation/cli/impact_records.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

const char* const what_it_is = "cost against true error";

std::string setting_words(const TradePoint& point) {
  if (point.tolerance > 0) return significant(point.tolerance, 1);
  if (point.step > 0) return fmt::format("{} s", significant(point.step, 2));
  return "";
}

std::string name_of(const TradePoint& point) {
  return point.method.empty() ? rung_name(point.rung) : fmt::format("{} {}", rung_name(point.rung), point.method);
}

/// Where the planar rung applies, the spatial one is the same but for rounding, and one set of points.
std::string curve_of(const Tradeoff& tradeoff, const TradePoint& point) {
  const bool is_twofold = point.rung == Rung::spatial &&
                          std::any_of(tradeoff.points.begin(), tradeoff.points.end(), [](const TradePoint& other) {
                            return other.rung == Rung::planar && other.failure.empty();
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

Json point_json(const TradePoint& point) {
  return {{"model", rung_name(point.rung)},
          {"method", point.method.empty() ? Json(nullptr) : Json(point.method)},
          {"tolerance", point.tolerance > 0 ? Json(point.tolerance) : Json(nullptr)},
          {"step", point.step > 0 ? Json(point.step) : Json(nullptr)},
          {"mesh", point.mesh.empty() ? Json(nullptr) : Json(point.mesh)},
          {"seconds", point.failure.empty() ? number_or_null(point.seconds) : Json(nullptr)},
          {"repeats", point.repeats},
          {"force_evaluations", point.evaluations},
          {"error", number_or_null(point.error)},
          {"front", point.pareto},
          {"failure", point.failure.empty() ? Json(nullptr) : Json(point.failure)}};
}

std::vector<std::string> head_of(const Scene& scene) {
  std::vector<std::string> head{headline("tradeoff", what_it_is)};
  for (const std::string& line : scene_head(scene)) head.push_back(line);
  return head;
}

std::string reference_words(const Tradeoff& tradeoff) {
  return fmt::format("error: largest over {} impacts, relative to the sequence's sizes; true values: {}, known to {}",
                     tradeoff.impacts, tradeoff.reference, significant(tradeoff.reference_error, 1));
}

}  // namespace

Table tradeoff_table(const Scene& scene, const Tradeoff& tradeoff) {
  Table table{.head = head_of(scene), .columns = {}, .rows = {}, .notes = {}};
  table.columns = {{.name = "model", .heading = "model", .unit = "", .words = true},
                   {.name = "method", .heading = "method", .unit = "", .words = true},
                   {.name = "setting", .heading = "setting", .unit = "", .words = true},
                   {.name = "mesh", .heading = "mesh", .unit = "", .words = true},
                   {"seconds", "cost", "ms"},
                   {"force_evaluations", "evaluations", ""},
                   {"error", "error", ""}};
  for (const TradePoint* point : front_of(tradeoff)) {
    table.rows.push_back({Cell(rung_name(point->rung)), Cell(point->method), Cell(setting_words(*point)),
                          Cell(point->mesh), Cell(1e3 * point->seconds, 2),
                          point->evaluations > 0 ? Cell(std::to_string(point->evaluations)) : Cell(),
                          Cell(point->error, 2)});
  }
  table.notes.push_back(
      fmt::format("The front: of {} points, those that none beats in both cost and error.", tradeoff.points.size()));
  table.notes.push_back(reference_words(tradeoff));
  for (const TradePoint& point : tradeoff.points) {
    if (point.failure.empty()) continue;
    const std::string setting = setting_words(point);
    table.notes.push_back(
        fmt::format("failed: {}{}{}: {}", name_of(point), setting.empty() ? "" : ", ", setting, point.failure));
  }
  return table;
}

Table tradeoff_records(const Scene& scene, const Tradeoff& tradeoff) {
  Table table{
      .head = {headline("tradeoff", what_it_is), "scene: " + scene.json().dump(), "body: " + body_json(scene).dump()},
      .columns = {},
      .rows = {},
      .notes = {reference_words(tradeoff)}};
  Json points = Json::array();
  for (const TradePoint& point : tradeoff.points) points.push_back(point_json(point));
  add_impact_records(table, points);
  return table;
}

Json tradeoff_json(const Scene& scene, const Tradeoff& tradeoff) {
  Json json{{"clatter", version},
            {"model", "tradeoff"},
            {"scene", scene.json()},
            {"body", body_json(scene)},
            {"points", Json::array()}};
  for (const TradePoint& point : tradeoff.points) json["points"].push_back(point_json(point));
  json["reference"] = tradeoff.reference;
  json["reference_error"] = number_or_null(tradeoff.reference_error);
  json["impacts"] = tradeoff.impacts;
  json["shortfall"] = tradeoff.shortfall.empty() ? Json(nullptr) : Json(tradeoff.shortfall);
  json["message"] = reference_words(tradeoff);
  return json;
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
