// SPDX-License-Identifier: GPL-3.0-or-later
// Error bars: how many errors lie within them, and how much wider they are than the errors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "validation/compare/random_scenes.hpp"
#include "validation/evidence/check.hpp"
#include "validation/evidence/discrete_bars.hpp"
#include "validation/output/number.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/run/motion_numbers.hpp"

namespace clatter::validation {
namespace {

constexpr int family = 9;
constexpr int scene_count = 60;
constexpr int discrete_impacts = 400;  ///< of a sequence that does not end before
constexpr double least_covered = 0.95;
constexpr double widest_median = 10;
/// Bars of the discrete model hold an ulp of each number given, too, which the drop of the check does not have.
constexpr double least_covered_discrete = 0.995, widest_discrete_median = 100;
/// Errors of single numbers below this part of the number's size are those of the truth too.
constexpr double truth_error = 1e-12;

/// Errors and bars of numbers, over the sizes of their sequence.
class BarSample {
 public:
  void take(double error, double bar) {
    ++count_;
    if (error <= bar + truth_error) ++covered_;
    if (error > truth_error) ratios_.push_back(bar / error);
  }

  /// @param scenes  in words
  [[nodiscard]] Measured measured(const std::string& scenes) {
    const double middle = upper_median(ratios_);
    const double outside = 1 - static_cast<double>(covered_) / static_cast<double>(count_);
    const bool holds = outside <= 1 - least_covered && middle <= widest_median;
    return {100 * (1 - outside), outside, holds_if(holds),
            fmt::format("% of {} numbers of {} lie within their bars; bars are {} times the error in the median",
                        count_, scenes, significant(middle, 2))};
  }

 private:
  std::size_t count_ = 0, covered_ = 0;
  std::vector<double> ratios_;
};

/// The same drop by another method, at a tolerance that is as good as none.
numeric::Simulation truth_of(const Scene& scene, const numeric::Body& body) {
  numeric::Accuracy accuracy = scene.accuracy;
  accuracy.method = numeric::Method::rkf45;
  accuracy.tolerance = 2e-13;
  const numeric::Request request{.impacts = scene.request.impacts, .error_estimates = false, .amplification = false};
  return numeric::simulate(body, scene.world, scene.start(body), request, accuracy);
}

Measured bars_of_the_simulator(CaseRuns& case_runs) {
  BarSample sample;
  for (int index = 0; index < scene_count; ++index) {
    if (!case_runs.goes_on()) throw CaseRuns::Interrupted{};
    Scene scene = random_scene(family, index);
    scene.accuracy.digits = 9;
    scene.request.impacts = 2;
    scene.accuracy.evaluation_limit = 300'000;  // soft grounds may hold a body for thousands of oscillations
    const numeric::Body body = scene.make_body();
    const numeric::Simulation run = run_to_digits(scene, body).run;
    const numeric::Simulation truth = truth_of(scene, body);
    if (run.impacts.empty()) continue;
    const MotionNumbers sizes = motion_sizes(run, run.impacts.size(), body);
    for (std::size_t i = 0; i < std::min(run.impacts.size(), truth.impacts.size()); ++i) {
      const numeric::ImpactRecord& row = run.impacts[i];
      if (!row.predictable || std::isnan(row.error.start)) continue;
      const Impact impact = impact_of(row);
      const MotionNumbers value = motion_numbers(impact.value), bar = motion_numbers(impact.error),
                          exact = motion_numbers(impact_of(truth.impacts[i]).value);
      for (std::size_t q = 0; q < motion_number_count; ++q) {
        if (exact[q] != 0) sample.take(std::fabs(value[q] - exact[q]) / sizes[q], bar[q] / sizes[q]);
      }
    }
  }
  return sample.measured(fmt::format("{} random scenes", scene_count));
}

Measured bars_of_the_discrete_model(CaseRuns& case_runs) {
  BarCoverage coverage;
  for (int index = 0; index < scene_count; ++index) {
    if (!case_runs.goes_on()) throw CaseRuns::Interrupted{};
    judge_bars(random_bar_scene(family, index), discrete_impacts, coverage);
    judge_bars(random_damped_bar_scene(family, index), discrete_impacts, coverage);
  }
  const double inside = static_cast<double>(coverage.rows_inside) / static_cast<double>(coverage.predictable);
  const bool holds = inside >= least_covered_discrete && coverage.median_ratio() <= widest_discrete_median &&
                     coverage.certain_ends_right == coverage.certain_ends;
  return {
      100 * inside, 1 - inside, holds_if(holds),
      fmt::format("% of {} predictable impacts of {} random scenes lie within their bars with all numbers; bars are {} "
                  "times the error in the median; {} of {} ends that are certain are right",
                  coverage.predictable, coverage.scenes, significant(coverage.median_ratio(), 2),
                  coverage.certain_ends_right, coverage.certain_ends)};
}

}  // namespace

CheckMeasures bar_measures() { return {{"B1", bars_of_the_discrete_model}, {"B2", bars_of_the_simulator}}; }

}  // namespace clatter::validation
