// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/tradeoff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "numeric/errors.hpp"

namespace clatter::validation {
namespace {

using numeric::Method;

constexpr Method adaptive[] = {Method::rk4, Method::rkf45, Method::rkck, Method::rk8pd};
constexpr int first_steps_per_contact = 8;  // tvd-rk3: contact time over 8, 16, …
constexpr int step_halvings = 11;
constexpr double tolerance_of_meshes = 1e-10;
constexpr int mesh_factors[] = {1, 2, 4, 8};

/// Runs `work` until it has been repeated often and long enough; least time.
template <class Work>
void time_it(const TradeoffOptions& options, TradePoint& point, const Work& work) {
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
      for (int i = 0; i < tolerance_count; ++i) {
        add(ladder_, {.level = level, .method = method, .tolerance = trade_tolerance(i)}, "");
      }
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

double trade_tolerance(int index) { return std::max(std::pow(10.0, -1 - index), numeric::least_tolerance); }

Tradeoff measure_tradeoff(const Scene& scene, const TradeoffOptions& options) { return Bench(scene, options).run(); }

}  // namespace clatter::validation
