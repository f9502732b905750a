// SPDX-License-Identifier: GPL-3.0-or-later
// What the steps of a foreign run say of the forces that act in flight.
#pragma once

#include <optional>
#include <vector>

#include "validation/benchmark/cause.hpp"
#include "validation/benchmark/motion.hpp"

namespace clatter::validation {

/// Velocities k times those with which the places change, if one k explains at least three quarters of the run's steps:
///     Δx = v Δt / k                                                                                  (1)
/// where v is the mean over the step.  Nothing for |1 − 1/k| ≤ 0.01.
[[nodiscard]] std::optional<Cause> velocity_scale_of(const Motion& motion, const Reference& reference);

/// Whether places and attitudes change as velocities and spin say, (1), for most of the steps.
[[nodiscard]] bool moves_by_its_velocities(const Motion& motion, const Reference& reference);

/// Another gravity, or damping of the velocity, of the spin or of both, if one of them explains at least three quarters
/// of the run's steps.  From the step of Δt between two rows, with the means v and L of velocity and angular momentum:
///     g = −ΔV_z/Δt,     c v Δt = −(ΔV + g Δt z),     d L Δt = −ΔL                                    (2)
/// each by the median over the steps, so that those with an impact do not count.  In space also an angular velocity
/// that stays constant, as of codes without the gyroscopic term.  Where an impact lasts many rows the body lies, rocks
/// or slides on the ground, and these say nothing of flight.
[[nodiscard]] std::vector<Cause> flight_causes_of(const Motion& motion, const Reference& reference);

/// A step of first order Δt, by whose velocities the places run ahead of free flight's or fall behind by
///     ±g Δt/2                                                                                        (3)
/// after each impact anew: + of the velocities at the step's end (semi-implicit Euler), − at its begin.  Its misfit is
/// the flight error that is left.
/// @param impacts all of the motion
[[nodiscard]] std::optional<Cause> first_order_step_of(const Motion& motion, const Reference& reference,
                                                       const ReferenceSequence& sequence,
                                                       const std::vector<FoundImpact>& impacts, double flight_error);

}  // namespace clatter::validation
