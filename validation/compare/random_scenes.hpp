// Random drops through both models: does the stiff limit hold what its error bars say?
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/scene/simulation_scene.hpp"

namespace clatter::validation {

/// Scene number `index` of the random family `seed`: a rod or a box of random size with random k_G, e (by c_G at the
/// speed of the drop), μ, angle, spin, tangential velocity and gravity.  The same on every machine.
[[nodiscard]] SimulationScene random_scene(std::uint64_t seed, int index);

/// One number of one impact: how far the limit is from the discrete value, and its error bar.
struct LimitSample {
  int scene = 0, impact = 0;
  std::size_t quantity = 0;
  double gap = 0, bar = 0;
};

struct RandomScenesResult {
  int scenes = 0;
  int with_limit = 0;  ///< that have a limit to hold against a discrete impact
  std::vector<LimitSample> samples;
  double covered = 0;     ///< share of the samples whose gap lies within the bar
  double median_bar = 0;  ///< of bar/gap
  std::string worst;      ///< the sample farthest outside, in words
};

/// Numbers that are equal by construction (the first start and angle) or zero in the discrete model are no samples.
[[nodiscard]] RandomScenesResult run_random_scenes(std::uint64_t seed, int first, int count, int impacts);
/// Statistics over the samples of several parts.
void summarise(RandomScenesResult& result);

}  // namespace clatter::validation
