// SPDX-License-Identifier: GPL-3.0-or-later
// Both models over every scene, and over random ones: the stiff limit is the discrete value.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/compare/random_scenes.hpp"
#include "validation/compare/random_space_scenes.hpp"
#include "validation/output/number.hpp"
#include "validation/verify/check.hpp"

namespace clatter::validation::inline verify {
namespace {

/// The farthest that a limit lies from the discrete value, over the size of the number at large.
struct LandingCount {
  double miss = 0;       ///< of all
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
      for (const auto& [name, heading, q] : comparison.discrete.quantities) {
        miss =
            std::max(miss, std::fabs(impact.limit->value[q] - (*impact.discrete)[q]) / comparison.discrete.scales[q]);
      }
    }
  }

  [[nodiscard]] Measured measured() const {
    return {static_cast<double>(landed), miss, holds_if(all_land),
            fmt::format("of {} impacts have their limit; at the scene's stiffness those compared are within {}",
                        impacts, significant(deviation, 2))};
  }
};

Measured of_case(CaseRuns& case_runs, const char* name) {
  LandingCount landing;
  landing.take(case_runs.comparison(name, 0));
  return landing.measured();
}

Measured of_sweep(CaseRuns& case_runs, const char* name) {
  LandingCount landing;
  for (const auto& [value, comparison] : case_runs.swept_comparison(name)) landing.take(comparison);
  return landing.measured();
}

constexpr std::uint64_t random_family = 1;
constexpr int random_impacts = 2;

Measured random_scenes(CaseRuns& case_runs, int count) {
  const RandomScenesResult result = run_random_scenes(
      {.seed = random_family, .count = count, .impacts = random_impacts, .goes_on = case_runs.goes_on});
  if (!result.complete) throw CaseRuns::Interrupted{};
  return {100 * result.covered, result.farthest, holds_if(result.covered >= 0.95 && result.median_bar <= 10),
          fmt::format("% of {} numbers of {} scenes lie within their bars; bars are {} times the gap in the median",
                      result.samples.size(), result.with_limit, significant(result.median_bar, 2))};
}

constexpr int random_impacts_in_space = 4;

Measured random_scenes_in_space(CaseRuns& case_runs, int count) {
  const RandomSpaceResult result = run_random_space_scenes(
      {.seed = random_family, .count = count, .impacts = random_impacts_in_space, .goes_on = case_runs.goes_on});
  if (!result.complete) throw CaseRuns::Interrupted{};
  const bool explained = std::ranges::none_of(result.unsettled, &std::string::empty, &UnsettledImpact::explanation);
  return {100 * result.share(), 1 - result.share(),
          holds_if(result.share() >= 0.95 && explained && result.median_bar <= 50),
          fmt::format("% of {} impacts of {} scenes lie within their bars with all numbers, {} are explained; bars are "
                      "{} times the gap in the median, the farthest limit is {} bars off",
                      result.impacts, count, result.unsettled.size(), significant(result.median_bar, 2),
                      significant(result.farthest, 2))};
}

}  // namespace

void add_model_measures(Measures& measures) {
  measures["M1"] = [](CaseRuns& case_runs) { return of_case(case_runs, "rod-45"); };
  measures["M2"] = [](CaseRuns& case_runs) { return of_sweep(case_runs, "rod-sweep"); };
  measures["M3"] = [](CaseRuns& case_runs) { return of_sweep(case_runs, "rod-friction-sweep"); };
  measures["M4"] = [](CaseRuns& case_runs) { return of_case(case_runs, "rod-friction-01"); };
  measures["M5"] = [](CaseRuns& case_runs) { return of_case(case_runs, "rod-friction-03"); };
  measures["M6"] = [](CaseRuns& case_runs) { return of_case(case_runs, "rod-friction-05"); };
  measures["M7"] = [](CaseRuns& case_runs) { return of_case(case_runs, "rod-friction-07"); };
  measures["M8"] = [](CaseRuns& case_runs) { return of_case(case_runs, "rod-at-1ms"); };
  measures["M9"] = [](CaseRuns& case_runs) { return of_case(case_runs, "rod-from-2m"); };
  measures["M10"] = [](CaseRuns& case_runs) { return of_case(case_runs, "phone-elastic"); };
  measures["M11"] = [](CaseRuns& case_runs) { return of_case(case_runs, "phone-damped"); };
  measures["M12"] = [](CaseRuns& case_runs) { return of_sweep(case_runs, "phone-sweep"); };
  measures["M13"] = [](CaseRuns& case_runs) { return of_case(case_runs, "every-key"); };
  measures["M14"] = [](CaseRuns& case_runs) { return of_case(case_runs, "rod-10"); };
  measures["M15"] = [](CaseRuns& case_runs) { return of_case(case_runs, "rod-damped"); };
  measures["M16"] = [](CaseRuns& case_runs) { return of_case(case_runs, "box-flat"); };
  measures["S7"] = [](CaseRuns& case_runs) { return of_case(case_runs, "phone-corner"); };
  measures["S8"] = [](CaseRuns& case_runs) { return random_scenes_in_space(case_runs, 20); };
  measures["S9"] = [](CaseRuns& case_runs) { return random_scenes_in_space(case_runs, 200); };
  measures["R1"] = [](CaseRuns& case_runs) { return random_scenes(case_runs, 20); };
  measures["R2"] = [](CaseRuns& case_runs) { return random_scenes(case_runs, 200); };
}

}  // namespace clatter::validation::inline verify
