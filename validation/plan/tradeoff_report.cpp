// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/tradeoff_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "numeric/base/errors.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/plan/plan.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

using numeric::Method;

constexpr Method adaptive[] = {Method::rk4, Method::rkf45, Method::rkck, Method::rk8pd};
constexpr int tolerance_count = 13;
constexpr int first_steps_per_contact = 8;  // tvd-rk3: contact time over 8, 16, …
constexpr int step_halvings = 11;
constexpr double tolerance_of_meshes = 1e-10;
constexpr int mesh_factors[] = {1, 2, 4, 8};

/// A tolerance of the adaptive methods, at least the smallest that is allowed.
double trade_tolerance(int index) { return std::max(std::pow(10.0, -1 - index), numeric::least_tolerance); }

/// Runs `work` until it has been repeated often and long enough; least time.
void time_it(const TradeoffOptions& options, TradePoint& point, const auto& work) {
  using Clock = std::chrono::steady_clock;
  double total = 0;
  point.seconds = std::numeric_limits<double>::infinity();
  while (point.repeats < options.least_repeats || total < options.least_seconds) {
    const auto begin = Clock::now();
    work();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    point.seconds = std::min(point.seconds, seconds);
    total += seconds;
    ++point.repeats;
  }
}

std::string without_truth(const Truth& truth) {
  const std::string why = truth.cut_short.empty() ? "" : ": " + truth.cut_short;
  return "the reference run has no impact that can be trusted" + why;
}

std::string shortfall_of(const Truth& truth, const Scene& scene) {
  if (!truth.cut_short.empty()) {
    return fmt::format("{} of {} impacts have a reference: {}", truth.rows.size(), scene.request.impacts,
                       truth.cut_short);
  }
  if (!scene.require_digits || truth.error <= std::pow(10.0, -scene.accuracy.digits)) return "";
  return fmt::format("asked {} digits, the reference is known to {:.1f}", scene.accuracy.digits,
                     -std::log10(truth.error));
}

/// The bench: the scene, its truth, and the points so far.
class Bench {
 public:
  Bench(const Scene& scene, const TradeoffOptions& options)
      : ladder_(limited(scene)), options_(options), truth_(true_values(ladder_)) {
    if (truth_.rows.empty()) throw numeric::NumericalError(without_truth(truth_));
    result_.impacts = impacts();
    result_.reference_error = truth_.error;
    result_.shortfall = shortfall_of(truth_, scene);
    result_.reference = fmt::format("{} model, {} at tolerance {}", level_name(truth_.setting.level),
                                    method_name(truth_.setting.method), truth_.setting.tolerance);
  }

  Tradeoff run() {
    for (const ModelLevel level : all_levels) add_rung(level);
    add_meshes();
    mark_front();
    return std::move(result_);
  }

 private:
  [[nodiscard]] int impacts() const { return static_cast<int>(truth_.rows.size()); }

  [[nodiscard]] std::size_t points_in_all() const {
    std::size_t count = std::size(mesh_factors);
    for (const ModelLevel level : all_levels) count += is_continuous(level) ? 0 : 1;
    for (const ModelLevel level : {ModelLevel::planar, ModelLevel::spatial}) {
      if (ladder_.against(level).empty()) count += std::size(adaptive) * tolerance_count + step_halvings;
    }
    return count;
  }

  [[nodiscard]] bool goes_on() {
    if (ended_) return false;
    ended_ = options_.progress && !options_.progress(result_.points.size(), points_in_all());
    return !ended_;
  }

  void add_rung(ModelLevel level) {
    if (!is_continuous(level) || !ladder_.against(level).empty()) return add(ladder_, {.level = level}, "");
    for (const Method method : adaptive) {
      for (int i = 0; i < tolerance_count; ++i)
        add(ladder_, {.level = level, .method = method, .tolerance = trade_tolerance(i)}, "");
    }
    for (int i = 0; i < step_halvings; ++i) {
      const double step = truth_.contact_time / (first_steps_per_contact << i);
      add(ladder_, {.level = level, .method = Method::tvd_rk3, .step = step}, "");
    }
  }

  void add(const ModelHierarchy& hierarchy, const LevelSetting& setting, const std::string& mesh) {
    if (!goes_on()) return;
    TradePoint point{.level = setting.level,
                     .method = is_continuous(setting.level) ? method_name(setting.method) : "",
                     .tolerance = setting.tolerance,
                     .step = setting.step,
                     .mesh = mesh,
                     .error = std::numeric_limits<double>::quiet_NaN(),
                     .failure = hierarchy.against(setting.level)};
    if (point.failure.empty()) measure(hierarchy, setting, point);
    result_.points.push_back(point);
  }

  void measure(const ModelHierarchy& hierarchy, const LevelSetting& setting, TradePoint& point) {
    try {
      LevelResult result;
      time_it(options_, point, [&] { result = hierarchy.run(setting, impacts()); });
      point.evaluations = result.evaluations;
      const double error = distance(result.rows, truth_.rows, truth_.sizes);
      if (std::isfinite(error)) point.error = error;
      else point.failure = fmt::format("{} of {} impacts: {}", result.rows.size(), truth_.rows.size(), result.ending);
    } catch (const std::exception& error) {
      point.failure = error.what();
    }
  }

  /// Other meshes of the same body: a rod's sectors change its shape, a box's elements only its cost.
  void add_meshes() {
    for (const int factor : mesh_factors) {
      Scene scene = ladder_.scene();
      std::string mesh;
      if (scene.body.shape == BodyScene::Shape::rod || scene.body.is_round()) {
        scene.body.sectors = 8 * factor;
        mesh = fmt::format("{} sectors", scene.body.sectors);
      } else if (scene.body.shape == BodyScene::Shape::box) {
        scene.body.nx = scene.body.ny = scene.body.nz = 2 * factor;
        scene.body.merge = false;
        mesh = fmt::format("{0}x{0}x{0} unmerged", 2 * factor);
      } else {
        return;
      }
      add(ModelHierarchy(scene), {.level = ladder_.full(), .method = Method::rk8pd, .tolerance = tolerance_of_meshes},
          mesh);
    }
  }

  void mark_front() {
    for (TradePoint& point : result_.points) {
      if (!point.failure.empty()) continue;
      point.pareto = std::none_of(result_.points.begin(), result_.points.end(), [&](const TradePoint& other) {
        return other.failure.empty() && other.seconds <= point.seconds && other.error <= point.error &&
               (other.seconds < point.seconds || other.error < point.error);
      });
    }
  }

  ModelHierarchy ladder_;
  const TradeoffOptions& options_;
  Truth truth_;
  Tradeoff result_;
  bool ended_ = false;
};

}  // namespace

Tradeoff measure_tradeoff(const Scene& scene, const TradeoffOptions& options) { return Bench(scene, options).run(); }

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

Picture tradeoff_picture(const Scene& scene, const Tradeoff& tradeoff) {
  PicturePanel panel{.columns = {{"curve", "1", "number of the model and method"},
                                 {"cost", "ms", "least wall time"},
                                 {"error", "1", "true error"}},
                     .plot = {.x_label = "cost [ms]",
                              .y_label = "largest true error, relative",
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

}  // namespace

Report tradeoff_report(const Scene& scene, const Tradeoff& tradeoff) {
  Report report = scene_report("tradeoff", tradeoff_summary, "tradeoff", scene);
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
  report.fields["points"] = row_objects(report.grid);
  report.fields["reference"] = tradeoff.reference;
  report.fields["reference_error"] = rounded_up(tradeoff.reference_error);
  report.fields["impacts"] = tradeoff.impacts;
  report.fields["shortfall"] = text_or_nothing(tradeoff.shortfall);
  report.fields["message"] = reference_words(tradeoff);
  return report;
}

namespace {

struct TradeoffInput {
  SceneFlags scene;
  OutputChoice output;
  PlotChoice plot;
};

int run_tradeoff(const TradeoffInput& input) {
  const Scene scene = read_scene_flags(input.scene);
  require_counted_impacts(scene, "tradeoff");
  const OutputChoice& choice = input.output;
  check_files(choice, plot_files(input.plot));
  if (scene.sweep) throw BadInput("{}: a sweep has no tradeoff; give --angle or leave out [sweep]", scene.path);
  PlotFile plot(input.plot);
  const CooperativeInterrupt interrupt;
  Tradeoff tradeoff;
  {
    Progress progress;
    TradeoffOptions options;
    options.progress = [&](std::size_t done, std::size_t of) {
      progress.show(progress_bar(done, of));
      return !interrupt.requested();
    };
    tradeoff = measure_tradeoff(scene, options);
  }
  Report report = tradeoff_report(scene, tradeoff);
  if (interrupt.requested()) note_interrupt("the models and settings that are not listed were not run", report);
  write_report(choice, report);
  if (interrupt.requested()) {
    plot.leave_out("interrupted");
    return interrupted_status;
  }
  plot.write(tradeoff_picture(scene, tradeoff), run_words("tradeoff", "cost against true error", scene));
  return status_of(tradeoff.shortfall);
}

}  // namespace

Command tradeoff_command() {
  return command_of<TradeoffInput>(run_tradeoff, [](Command& command, TradeoffInput& input) {
    add_scene_flags(command, input.scene);
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer =
        "Example: clatter plan --tradeoff rod-45 --plot tradeoff.svg\n"
        "The table shows the front, --format csv all points.";
    command.columns = {{"tradeoff", tradeoff_columns}};
  });
}

}  // namespace clatter::validation
