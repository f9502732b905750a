// SPDX-License-Identifier: GPL-3.0-or-later
// What the steps of a foreign run say of the forces that act in flight.
#pragma once

#include <optional>
#include <vector>

#include "validation/benchmark/cause.hpp"
#include "validation/benchmark/motion.hpp"

namespace clatter::validation::inline benchmark {

/// Velocities k times those with which the places change, if one k explains at least three quarters of the run's steps:
///     Δx = v Δt / k                                                                                  (1)
/// where v is the mean over the step.  Nothing for |1 − 1/k| ≤ 0.01.
[[nodiscard]] std::optional<Cause> velocity_scale_of(const Motion& motion, const Reference& reference);

/// Another gravity, or damping of the velocity, of the spin or of both, if one of them explains at least three quarters
/// of the run's steps.  From the step of Δt between two rows, with the means v and L of velocity and angular momentum:
///     g = −ΔV_z/Δt,     c v Δt = −(ΔV + g Δt z),     d L Δt = −ΔL                                    (2)
/// each by the median over the steps, so that those with an impact do not count.  In space also an angular velocity
/// that stays constant, as of codes without the gyroscopic term.
[[nodiscard]] std::vector<Cause> flight_causes_of(const Motion& motion, const Reference& reference);

}  // namespace clatter::validation::inline benchmark
