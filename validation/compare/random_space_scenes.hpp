// SPDX-License-Identifier: GPL-3.0-or-later
// Random drops in space through both models: does the stiff limit hold what its error bars say?
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/compare/comparison.hpp"

namespace clatter::validation {

/// A scene with its body, which no file describes where it is a tetrahedron or an L.
struct SpaceScene {
  Scene scene;
  numeric::Body body;
};

/// Scene number `index` of the random family `seed`: in turn a box, a box with its mass off the middle, a tetrahedron
/// and an L of random size, in any attitude, with random k_G, e (by c_G at the speed of the drop), μ, gravity,
/// velocity along the ground and spin.  The same on every machine.
[[nodiscard]] SpaceScene random_space_scene(std::uint64_t seed, int index);

/// Which scenes of a family to run.
struct RandomSpaceScenes {
  std::uint64_t seed = 0;
  int count = 0;                                        ///< scenes 0 to count − 1
  int impacts = 0;                                      ///< of each
  std::function<bool()> goes_on = [] { return true; };  ///< asked before each scene; false ends the run
};

/// An impact without a limit within its bar.
struct UnsettledImpact {
  int scene = 0, n = 0;
  std::string explanation;  ///< empty: nothing says why
};

struct RandomSpaceResult {
  bool complete = true;  ///< false: ended by `goes_on`, and the numbers are those of the scenes before
  int impacts = 0;       ///< of the discrete model, up to the first of several corners and to the end of predictability
  int within = 0;        ///< of those: each number of the limit lies within its error bar of the discrete value
  double median_bar = 0;                   ///< of bar/gap, over the numbers with a gap above 1e-12 of their scale
  double farthest = 0;                     ///< largest gap over bar and discrete error together
  double largest_bar = 0;                  ///< over the number's scale
  std::vector<UnsettledImpact> unsettled;  ///< the others

  [[nodiscard]] double share() const { return static_cast<double>(within) / static_cast<double>(impacts); }
};

[[nodiscard]] RandomSpaceResult run_random_space_scenes(const RandomSpaceScenes& scenes);

}  // namespace clatter::validation
