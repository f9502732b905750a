// SPDX-License-Identifier: GPL-3.0-or-later
// A random scene, its plan, and whether the plan was right.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "validation/compare/random_scenes.hpp"
#include "validation/plan/plan.hpp"

namespace clatter::validation {

struct PlannedScene {
  int digits = 0;
  bool judged = false;    ///< the true values are known ten times better than what was asked
  bool promised = false;  ///< the plan said that its choice serves; what is judged then must be met
  bool met = false;       ///< it does
  double error = 0, predicted = 0;
  double cost_ratio = 0;      ///< evaluations of the choice over those of the cheapest setting that serves
  double planning_ratio = 0;  ///< evaluations of the pilots over those of the choice
  std::string choice;
};

/// Evaluations of the cheapest of all levels, four methods and half-decade tolerances that serves; infinite: none does.
inline double cheapest_that_serves(const ModelHierarchy& hierarchy, const Truth& truth, double asked) {
  using numeric::Method;
  const int impacts = static_cast<int>(truth.rows.size());
  const auto serves = [&](const LevelResult& result) {
    return distance(result.rows, truth.rows, truth.sizes) <= asked;
  };
  for (const ModelLevel level : {ModelLevel::closed_form, ModelLevel::discrete}) {
    if (hierarchy.against(level).empty() && serves(hierarchy.run({.level = level}, impacts))) return 0;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Method method : {Method::rkck, Method::rk8pd, Method::rkf45, Method::rk4}) {
    for (int i = 2; i <= 26; ++i) {
      const double tolerance = std::max(std::pow(10.0, -0.5 * i), numeric::least_tolerance);
      const LevelSetting setting{.level = hierarchy.full(), .method = method, .tolerance = tolerance};
      const LevelResult result = hierarchy.run(setting, impacts);
      const auto evaluations = static_cast<double>(result.evaluations);
      if (evaluations < least && serves(result)) least = evaluations;
      if (evaluations > 3 * least) break;  // tighter ones cost more
    }
  }
  return least;
}

/// Scene `index` of family `seed`, 2 to 9 digits of its first three impacts asked for.
inline PlannedScene plan_and_judge(std::uint64_t seed, int index) {
  Scene scene = random_scene(seed, index);
  scene.request.impacts = 3;
  scene.accuracy.evaluation_limit = 300'000;
  PlannedScene result;
  result.digits = 2 + index % 8;
  const Plan plan = make_plan(scene, {.digits = result.digits});
  result.promised = plan.serves;
  const Truth truth = true_values(ModelHierarchy(scene), plan.asked / 10);
  result.judged = !truth.rows.empty() && static_cast<int>(truth.rows.size()) >= plan.impacts;
  if (!result.judged || !result.promised) return result;
  const ModelHierarchy chosen(plan.scene);
  const LevelResult run = chosen.run(plan.choice, static_cast<int>(truth.rows.size()));
  result.error = distance(run.rows, truth.rows, truth.sizes);
  result.predicted = plan.error;
  result.met = result.error <= plan.asked;
  const double evaluations = is_continuous(plan.choice.level) ? static_cast<double>(run.evaluations) : 0;
  const double cheapest = cheapest_that_serves(ModelHierarchy(scene), truth, plan.asked);
  result.cost_ratio = evaluations == cheapest ? 1 : evaluations / cheapest;
  result.planning_ratio = static_cast<double>(plan.planning_evaluations) / std::max(evaluations, 1.0);
  result.choice = fmt::format("{} {} {:.0e}", level_name(plan.choice.level), method_name(plan.choice.method),
                              plan.choice.tolerance);
  return result;
}

}  // namespace clatter::validation
