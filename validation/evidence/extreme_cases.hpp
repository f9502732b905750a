// SPDX-License-Identifier: GPL-3.0-or-later
// What the cells of the discrete model, those of very many turns, the tracked drops and the long runs compute, and how
// each number is judged.
#pragma once

#include <cstdint>
#include <vector>

#include "analytic/plane/sequence.hpp"
#include "validation/evidence/cell.hpp"

namespace clatter::validation {

/// The sequence of a drop, without amplification; its outcome, time and evaluations go to `measure`.
/// @throws analytic::NumericalError if a number of it could not be computed, OutsideModelError if an impact jams.
[[nodiscard]] analytic::Sequence timed_sequence(const analytic::Drop& drop, int impacts, CellMeasure& measure);

/// Cells of the closed form and of the discrete model on an axis; none if it has no such quantity.
[[nodiscard]] std::vector<ExtremeCase> discrete_cases(const MapAxis& axis);
/// All models' cells on the axis "turns".
[[nodiscard]] std::vector<ExtremeCase> turn_cases(const MapAxis& axis);

/// The axes "disc", "needle", "slenderness", "bounces" and "hops": round bodies of the discrete model in space, and how
/// their bouncing ends.
[[nodiscard]] std::vector<ExtremeCase> rim_cases(const MapAxis& axis);

/// The axes "squares" and "cubes": predictions held against the tracked drops that the program carries, to see where a
/// rigid body that strikes with one corner stops describing them.
[[nodiscard]] std::vector<ExtremeCase> measured_cases(const MapAxis& axis);

/// Runs longer than a second, one cell each.
struct LongRuns {
  int impacts = 10'000;           ///< of the elastic phone, planar and spatial
  int discrete_scenes = 100'000;  ///< random ones
  int continuous_scenes = 1'000;
  std::uint64_t seed = 1;  ///< of the random scenes
};
/// @param goes_on asked now and then; false ends the cell early
[[nodiscard]] std::vector<ExtremeCase> long_cases(const LongRuns& runs, const std::function<bool()>& goes_on);

}  // namespace clatter::validation
