// SPDX-License-Identifier: GPL-3.0-or-later
// Which points of a body took the impulses of one step of a sampled motion, and when.
#pragma once

#include <vector>

#include "validation/benchmark/motion.hpp"

namespace clatter::validation::inline benchmark {

/// An impulse of a step at one point, or at several that came down together.
struct StepImpulse {
  std::vector<int> points;  ///< ascending; none: no point of the body explains the step
  analytic::space::Vector3 impulse = analytic::space::Vector3::Zero();  ///< [N·s]
  double time = 0;                                                      ///< [s]
  double approach = 0;    ///< normal velocity of the first of the points right before [m/s]
  double separation = 0;  ///< and right after [m/s]
};

/// Cuts the jump between two rows into impulses, the earlier first.
///
/// The flights before and after an impact meet at its instant,
///     s = (z₀ − z₁ + V₁ Δt + g Δt²/2)/(V₁ − V₀ + g Δt)   after the first row,                        (1)
/// from their heights alone.  A point r explains a jump if r × P is the change of the angular momentum, at (1) or,
/// since a code may strike with either, with the pose of the first or last row.  Two points do, one after the other, if
///     r₁ × λP + r₂ × (1 − λ)P                                                                        (2)
/// is, r₁ where the flight before touches the ground, r₂ where the flight after leaves it.
/// More than two impacts within a step cannot be told apart.
/// @pre row + 1 < motion.size()
[[nodiscard]] std::vector<StepImpulse> step_impulses(const Motion& motion, const Reference& reference, std::size_t row);

/// s of (1), within the step [s].
[[nodiscard]] double meeting_time(const analytic::space::State& before, const analytic::space::State& after,
                                  double step, double gravity);

}  // namespace clatter::validation::inline benchmark
