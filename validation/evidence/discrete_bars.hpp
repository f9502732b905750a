// SPDX-License-Identifier: GPL-3.0-or-later
// Error bars of the discrete model against event simulations of 80 digits and more.
#pragma once

#include <string>
#include <vector>

#include "analytic/plane/sequence.hpp"

namespace clatter::validation {

enum class BarShape { thin_rod, rod, box };

/// A drop in numbers that the model and the simulation put together each for itself.
struct BarScene {
  BarShape shape = BarShape::thin_rod;
  double mass = 1, length = 1;
  double half_thickness = 0;  ///< of a box, or the rod's radius [m]
  double degrees = 0;         ///< inclination
  analytic::PlanarVelocity velocity;
  double gravity = 0;
  analytic::ImpactLaw law;
  int digits = 6;  ///< SequenceOptions::digits

  [[nodiscard]] analytic::Drop drop() const;
  [[nodiscard]] std::string words() const;
};

/// Scene number `index` of a family: rods and boxes of any tilt, e from 0.001 to 0.98, all laws of
/// restitution but the viscoelastic one, no friction, an impulse ratio or Coulomb's law, with
/// gravity or, one in eight, without.
[[nodiscard]] BarScene random_bar_scene(unsigned family, int index);

/// The same drop on viscoelastic ground, with a damping number of the first approach of the centre
/// of mass from 0.001 to 3.
[[nodiscard]] BarScene random_damped_bar_scene(unsigned family, int index);

/// How many numbers lie within their bars.
struct BarCoverage {
  long scenes = 0;       ///< compared: without those whose first contact recedes, that jam or fly off
  long rows = 0;         ///< impacts
  long predictable = 0;  ///< rows that are said to be known
  long rows_inside = 0;  ///< of these, with each number within its bar
  long numbers = 0, numbers_inside = 0;
  long certain_ends = 0, certain_ends_right = 0;  ///< Sequence::end_predictable
  long not_judged = 0;                            ///< certain ends that the simulation's digits did not reach
  long sums = 0, sums_inside = 0;                 ///< totals and tails of certain ends
  std::vector<double> ratios;                     ///< bar over error
  std::vector<std::string> outside;               ///< what lies outside, in words

  [[nodiscard]] double median_ratio() const;
};

/// Runs a scene to its end, or up to `impacts`, in the model, and as far in the simulation as what
/// the model says needs for being judged; adds what was found.
void judge_bars(const BarScene& scene, int impacts, BarCoverage& coverage);

}  // namespace clatter::validation
