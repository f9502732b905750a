// SPDX-License-Identifier: GPL-3.0-or-later
// What a second run of a drop says about the errors of the first.
#pragma once

#include <vector>

#include "numeric/drop/drop_run.hpp"

namespace clatter::numeric::inline drop {

/// How the second run is computed, and how many times its distance from the main run the error of that run may be.
struct SecondRun {
  Integration integration;
  double error_per_distance = 0;
};

/// The second run is finer than the main one: a tenth of its tolerance and shorter longest steps, or half its step. The
/// distance of the two is then the main run's error but for a part: 10^(−q), q the power of the tolerance with which
/// errors fall (0.9), or 1/8 for order three.  Where a tenth of the tolerance is below least_tolerance, the second run
/// is ten times coarser.
/// @param used_step  of the main run, fixed [s]
[[nodiscard]] SecondRun second_run(const Integration& main, double used_step);

/// Fills in `error` of each row: error_per_distance × |row − second's row|, and what rounding leaves, grown by the
/// row's amplification: 4 ε (1 + amplification) × the size of what the number is computed from; of a time, also the
/// body's radius over the speed at which the ground is reached or left.  A vector's component takes at least a tenth of
/// the vector's distance, duration, restitution and peak force of the impulse's relative one, and energies and works
/// that relative one of the energy before: two runs may agree by chance.  Rows that the second run does not have, or
/// has with another end or number of touches, get NaN: not known.
void estimate_errors(const Body& body, double error_per_distance, std::vector<ImpactRecord>& rows,
                     const std::vector<ImpactRecord>& second);

/// Errors of all rows: not known (NaN).
void forget_errors(std::vector<ImpactRecord>& rows);

}  // namespace clatter::numeric::inline drop
