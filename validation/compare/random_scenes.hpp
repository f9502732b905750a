// SPDX-License-Identifier: GPL-3.0-or-later
// Random drops through both models: does the stiff limit hold what its error bars say?
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// Scene number `index` of the random family `seed`: a rod or a box of random size with random k_G, e (by c_G at the
/// speed of the drop), μ, angle, spin, tangential velocity and gravity.  The same on every machine.
[[nodiscard]] Scene random_scene(std::uint64_t seed, int index);

/// Which scenes of a family to run.
struct RandomScenes {
  std::uint64_t seed = 0;
  int count = 0;                                        ///< scenes 0 to count − 1
  int impacts = 0;                                      ///< of each
  std::function<bool()> goes_on = [] { return true; };  ///< asked before each scene; false ends the run
};

/// One number of one impact: how far the limit is from the discrete value, and its error bar.
struct LimitSample {
  double gap = 0, bar = 0;
};

struct RandomScenesResult {
  bool complete = true;  ///< false: ended by `goes_on`, and the numbers are those of the scenes before
  int with_limit = 0;    ///< scenes that have a limit to hold against a discrete impact
  std::vector<LimitSample> samples;
  double covered = 0;     ///< share of the samples whose gap lies within the bar
  double median_bar = 0;  ///< of bar/gap
  double farthest = 0;    ///< largest gap/bar
};

/// Numbers that are equal by construction (the first start and angle) or zero in the discrete model are no samples.
[[nodiscard]] RandomScenesResult run_random_scenes(const RandomScenes& scenes);

}  // namespace clatter::validation
