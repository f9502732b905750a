// SPDX-License-Identifier: GPL-3.0-or-later
// How often a plan keeps its word, and what its choice costs next to the cheapest that would have done:
//     plan_benchmark [SCENES [SEED]]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "tests/validation/plan/planned_scene.hpp"

using namespace clatter::validation;

namespace {

double share(const std::vector<PlannedScene>& scenes, const auto& holds) {
  const auto count = std::count_if(scenes.begin(), scenes.end(), holds);
  return 100.0 * static_cast<double>(count) / static_cast<double>(scenes.size());
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

int main(int count, char** texts) {
  const int scenes = count > 1 ? std::atoi(texts[1]) : 1000;
  const std::uint64_t seed = count > 2 ? std::strtoull(texts[2], nullptr, 10) : 5;
  std::vector<PlannedScene> judged;
  int unjudged = 0;
  for (int i = 0; i < scenes; ++i) {
    const PlannedScene planned = plan_and_judge(seed, i);
    if (!planned.judged) ++unjudged;
    else judged.push_back(planned);
    if (planned.judged && !(planned.met && planned.cost_ratio <= 1.5)) {
      fmt::print("scene {}: {} digits, {}: error {:.1e} (predicted {:.1e}), {:.2f} times the cheapest\n", i,
                 planned.digits, planned.choice, planned.error, planned.predicted, planned.cost_ratio);
    }
  }
  std::vector<double> ratios, planning;
  for (const PlannedScene& scene : judged) {
    if (!scene.met) continue;
    ratios.push_back(scene.cost_ratio);
    planning.push_back(scene.planning_ratio);
  }
  fmt::print("{} scenes: {} judged, {} whose true values cannot be known ten times better than asked\n", scenes,
             judged.size(), unjudged);
  fmt::print("digits met: {:.2f} %\n", share(judged, [](const PlannedScene& scene) { return scene.met; }));
  fmt::print("at most 1.5 times the cheapest: {:.2f} %; median {:.2f}, nine in ten {:.2f}\n",
             share(judged, [](const PlannedScene& scene) { return scene.met && scene.cost_ratio <= 1.5; }),
             quantile(ratios, 0.5), quantile(ratios, 0.9));
  fmt::print("planning takes {:.1f} times the evaluations of the choice (median)\n", quantile(planning, 0.5));
}
