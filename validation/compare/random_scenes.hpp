// SPDX-License-Identifier: GPL-3.0-or-later
// Random drops through both models: does the stiff limit hold what its error bars say?
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "validation/compare/comparison.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

// Uniform random numbers that do not depend on the library's distributions.

/// Random numbers of member `index` of the random family `seed`.
class Uniform {
 public:
  Uniform(std::uint64_t seed, int index) : engine_(seed + 1'000'003ULL * static_cast<std::uint64_t>(index)) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double logarithmic(double low, double high) { return std::exp((*this)(std::log(low), std::log(high))); }
  bool one_in(int n) { return (*this)(0, n) < 1; }

 private:
  std::mt19937_64 engine_;
};

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

struct RandomScenesResult {
  bool complete = true;     ///< false: ended by `goes_on`, and the numbers are those of the scenes before
  int with_limit = 0;       ///< scenes that have a limit to hold against a discrete impact
  std::size_t samples = 0;  ///< numbers of impacts with a gap between limit and discrete value, and an error bar
  double covered = 0;       ///< share of the samples whose gap lies within the bar
  double median_bar = 0;    ///< of bar/gap
  double farthest = 0;      ///< largest gap/bar
};

/// Numbers that are equal by construction (the first start and angle) or zero in the discrete model are no samples.
[[nodiscard]] RandomScenesResult run_random_scenes(const RandomScenes& scenes);

// Random drops in space through both models: does the stiff limit hold what its error bars say?

/// A scene with its body, which no file describes where it is a tetrahedron or an L.
struct SpaceScene {
  Scene scene;
  numeric::Body body;
};

/// Scene number `index` of the random family `seed`: in turn a box, a box with its mass off the middle, a tetrahedron
/// and an L of random size, in any attitude, with random k_G, e (by c_G at the speed of the drop), μ, gravity,
/// velocity along the ground and spin.  The same on every machine.
[[nodiscard]] SpaceScene random_space_scene(std::uint64_t seed, int index);

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

[[nodiscard]] RandomSpaceResult run_random_space_scenes(const RandomScenes& scenes);

}  // namespace clatter::validation
