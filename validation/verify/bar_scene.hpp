// SPDX-License-Identifier: GPL-3.0-or-later
// Drops for the check of the discrete model's error bars.
#pragma once

#include <string>

#include "analytic/plane/sequence.hpp"

namespace clatter::validation::inline verify {

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

}  // namespace clatter::validation::inline verify
