// SPDX-License-Identifier: GPL-3.0-or-later
// Both models over every scene, and over random ones: the stiff limit is the discrete value; and over tracked drops.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/compare/random_scenes.hpp"
#include "validation/evidence/check.hpp"
#include "validation/measured/score.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

/// The farthest that a limit lies from the discrete value, over the size of the number at large.
struct LandingCount {
  WorstError miss;       ///< of all
  double deviation = 0;  ///< at the scene's own stiffness
  int impacts = 0, landed = 0;
  bool all_land = true;

  void take(const Comparison& comparison) {
    for (const ComparedImpact& impact : comparison.impacts) {
      ++impacts;
      for (const auto& [name, heading, q] : comparison.discrete.quantities) {
        if (!impact.reason.empty()) break;
        deviation = std::max(
            deviation, std::fabs((*impact.continuous)[q] - (*impact.discrete)[q]) / comparison.discrete.scales[q]);
      }
      if (!impact.has_landing()) continue;
      ++landed;
      all_land = all_land && impact.lands();
      for (const auto& [name, heading, q] : comparison.discrete.quantities)
        miss.take(std::fabs(impact.limit->value[q] - (*impact.discrete)[q]) / comparison.discrete.scales[q]);
    }
  }

  [[nodiscard]] Measured measured() const {
    return {static_cast<double>(landed), miss.value(), holds_if(all_land),
            fmt::format("of {} impacts have their limit; at the scene's stiffness those compared are within {}",
                        impacts, significant(deviation, 2))};
  }
};

Measure of_case(const char* name) {
  return [=](CaseRuns& case_runs) {
    LandingCount landing;
    landing.take(case_runs.comparison(name, 0));
    return landing.measured();
  };
}

Measure of_sweep(const char* name) {
  return [=](CaseRuns& case_runs) {
    LandingCount landing;
    for (const auto& [value, comparison] : case_runs.swept_comparison(name)) landing.take(comparison);
    return landing.measured();
  };
}

constexpr std::uint64_t random_family = 1;
constexpr int random_impacts = 2;

Measure random_scenes(int count) {
  return [=](CaseRuns& case_runs) -> Measured {
    const RandomScenesResult result = run_random_scenes(
        {.seed = random_family, .count = count, .impacts = random_impacts, .goes_on = case_runs.goes_on});
    if (!result.complete) throw CaseRuns::Interrupted{};
    return {100 * result.covered, result.farthest, holds_if(result.covered >= 0.95 && result.median_bar <= 10),
            fmt::format("% of {} numbers of {} scenes lie within their bars; bars are {} times the gap in the median",
                        result.samples, result.with_limit, significant(result.median_bar, 2))};
  };
}

constexpr int random_impacts_in_space = 4;

Measure random_scenes_in_space(int count) {
  return [=](CaseRuns& case_runs) -> Measured {
    const RandomSpaceResult result = run_random_space_scenes(
        {.seed = random_family, .count = count, .impacts = random_impacts_in_space, .goes_on = case_runs.goes_on});
    if (!result.complete) throw CaseRuns::Interrupted{};
    const bool explained = std::ranges::none_of(result.unsettled, &std::string::empty, &UnsettledImpact::explanation);
    return {
        100 * result.share(), 1 - result.share(),
        holds_if(result.share() >= 0.95 && explained && result.median_bar <= 50),
        fmt::format("% of {} impacts of {} scenes lie within their bars with all numbers, {} are explained; bars are "
                    "{} times the gap in the median, the farthest limit is {} bars off",
                    result.impacts, count, result.unsettled.size(), significant(result.median_bar, 2),
                    significant(result.farthest, 2))};
  };
}

/// Predictions held against drops that cameras tracked.
Measure velocities(const char* name) {
  return [=](CaseRuns&) -> Measured {
    const Scores scores = kept_scores(name);
    const double error = scores.middle_of("as fitted");
    return {100 * error, error, Finding::holds,
            fmt::format("{} point impacts; no change {} %, the best impulse there {} %", scores.rows[0].errors.size(),
                        significant(100 * scores.middle_of("no change"), 3),
                        significant(100 * scores.middle_of("floor: any impulse there"), 2))};
  };
}

/// Impacts that no impulse at one corner explains are two or more impacts of the sequence.
Measured clattering(CaseRuns&) {
  const Scores scores = kept_scores("square-drops");
  const double one = scores.middle_of("no point impact: one impact"),
               sequence = scores.middle_of("no point impact: the sequence");
  return {100 * sequence, sequence, holds_if(sequence < one),
          fmt::format("with one impact alone {} %", significant(100 * one, 3))};
}

}  // namespace

CheckMeasures model_measures() {
  return {
      {"M1", of_case("rod-45")},           {"M2", of_sweep("rod-sweep")},      {"M3", of_sweep("rod-friction-sweep")},
      {"M4", of_case("rod-friction-01")},  {"M5", of_case("rod-friction-03")}, {"M6", of_case("rod-friction-05")},
      {"M7", of_case("rod-friction-07")},  {"M8", of_case("rod-at-1ms")},      {"M9", of_case("rod-from-2m")},
      {"M10", of_case("phone-elastic")},   {"M11", of_case("phone-damped")},   {"M12", of_sweep("phone-sweep")},
      {"M13", of_case("every-key")},       {"M14", of_case("rod-10")},         {"M15", of_case("rod-damped")},
      {"M16", of_case("box-flat")},        {"R1", random_scenes(20)},          {"R2", random_scenes(200)},
      {"S7", of_case("phone-corner")},     {"S8", random_scenes_in_space(20)}, {"S9", random_scenes_in_space(200)},
      {"X20", velocities("square-drops")}, {"X21", velocities("cube-tosses")}, {"X22", clattering}};
}

}  // namespace clatter::validation
