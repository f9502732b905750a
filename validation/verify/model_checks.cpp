// Both models over every scene, and over random ones: the stiff limit is the discrete value.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/compare/random_scenes.hpp"
#include "validation/compare/random_space_scenes.hpp"
#include "validation/output/number.hpp"
#include "validation/verify/check.hpp"

namespace clatter::validation {
namespace {

/// The farthest that a limit lies from the discrete value, over the size of the number at large.
struct Landing {
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
    return {static_cast<double>(landed), miss, all_land ? Answer::holds : Answer::refuted,
            fmt::format("of {} impacts have their limit; at the scene's stiffness those compared are within {}",
                        impacts, significant(deviation, 2))};
  }
};

Measured of_case(Laboratory& laboratory, const char* name) {
  Landing landing;
  landing.take(laboratory.comparison(name, 0));
  return landing.measured();
}

Measured of_sweep(Laboratory& laboratory, const char* name) {
  Landing landing;
  for (const auto& [value, comparison] : laboratory.swept_comparison(name)) landing.take(comparison);
  return landing.measured();
}

constexpr std::uint64_t random_family = 1;
constexpr int random_impacts = 2;

Measured random_scenes(Laboratory& laboratory, int count) {
  const RandomScenesResult result = run_random_scenes(
      {.seed = random_family, .count = count, .impacts = random_impacts, .goes_on = laboratory.goes_on});
  if (!result.complete) throw Laboratory::Interrupted{};
  return {100 * result.covered, result.farthest,
          result.covered >= 0.95 && result.median_bar <= 10 ? Answer::holds : Answer::refuted,
          fmt::format("% of {} numbers of {} scenes lie within their bars; bars are {} times the gap in the median",
                      result.samples.size(), result.with_limit, significant(result.median_bar, 2))};
}

constexpr int random_impacts_in_space = 4;

Measured random_scenes_in_space(Laboratory& laboratory, int count) {
  const RandomSpaceResult result = run_random_space_scenes(
      {.seed = random_family, .count = count, .impacts = random_impacts_in_space, .goes_on = laboratory.goes_on});
  if (!result.complete) throw Laboratory::Interrupted{};
  const bool explained = std::ranges::none_of(result.unsettled, &std::string::empty, &UnsettledImpact::explanation);
  return {100 * result.share(), 1 - result.share(),
          result.share() >= 0.95 && explained && result.median_bar <= 50 ? Answer::holds : Answer::refuted,
          fmt::format("% of {} impacts of {} scenes lie within their bars with all numbers, {} are explained; bars are "
                      "{} times the gap in the median, the farthest limit is {} bars off",
                      result.impacts, count, result.unsettled.size(), significant(result.median_bar, 2),
                      significant(result.farthest, 2))};
}

}  // namespace

void add_model_measures(Measures& measures) {
  measures["M1"] = [](Laboratory& laboratory) { return of_case(laboratory, "rod-45"); };
  measures["M2"] = [](Laboratory& laboratory) { return of_sweep(laboratory, "rod-sweep"); };
  measures["M3"] = [](Laboratory& laboratory) { return of_sweep(laboratory, "rod-friction-sweep"); };
  measures["M4"] = [](Laboratory& laboratory) { return of_case(laboratory, "rod-friction-01"); };
  measures["M5"] = [](Laboratory& laboratory) { return of_case(laboratory, "rod-friction-03"); };
  measures["M6"] = [](Laboratory& laboratory) { return of_case(laboratory, "rod-friction-05"); };
  measures["M7"] = [](Laboratory& laboratory) { return of_case(laboratory, "rod-friction-07"); };
  measures["M8"] = [](Laboratory& laboratory) { return of_case(laboratory, "rod-at-1ms"); };
  measures["M9"] = [](Laboratory& laboratory) { return of_case(laboratory, "rod-from-2m"); };
  measures["M10"] = [](Laboratory& laboratory) { return of_case(laboratory, "phone-elastic"); };
  measures["M11"] = [](Laboratory& laboratory) { return of_case(laboratory, "phone-damped"); };
  measures["M12"] = [](Laboratory& laboratory) { return of_sweep(laboratory, "phone-sweep"); };
  measures["M13"] = [](Laboratory& laboratory) { return of_case(laboratory, "every-key"); };
  measures["M14"] = [](Laboratory& laboratory) { return of_case(laboratory, "rod-10"); };
  measures["M15"] = [](Laboratory& laboratory) { return of_case(laboratory, "rod-damped"); };
  measures["M16"] = [](Laboratory& laboratory) { return of_case(laboratory, "box-flat"); };
  measures["S7"] = [](Laboratory& laboratory) { return of_case(laboratory, "phone-corner"); };
  measures["S8"] = [](Laboratory& laboratory) { return random_scenes_in_space(laboratory, 20); };
  measures["S9"] = [](Laboratory& laboratory) { return random_scenes_in_space(laboratory, 200); };
  measures["R1"] = [](Laboratory& laboratory) { return random_scenes(laboratory, 20); };
  measures["R2"] = [](Laboratory& laboratory) { return random_scenes(laboratory, 200); };
}

}  // namespace clatter::validation
