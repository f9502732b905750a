// SPDX-License-Identifier: GPL-3.0-or-later
// What each cell of the map runs, and how its number is judged.
#pragma once

#include <cstdint>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/plane/sequence.hpp"
#include "validation/extremes/axes.hpp"
#include "validation/extremes/cell.hpp"

namespace clatter::validation::inline extremes {

/// The sequence of a drop.  @throws analytic::NumericalError if a number of it could not be computed, OutsideModelError
/// if an impact jams.
[[nodiscard]] inline analytic::Sequence whole_sequence(const analytic::Drop& drop,
                                                       const analytic::SequenceOptions& options) {
  analytic::Sequence sequence = impact_sequence(drop, options);
  if (sequence.outcome == analytic::Outcome::not_computed) throw analytic::NumericalError(sequence.message);
  if (sequence.outcome == analytic::Outcome::outside_model) throw analytic::OutsideModelError(sequence.message);
  return sequence;
}

/// Cells of the closed form and of the discrete model on an axis; none if it has no such quantity.
[[nodiscard]] std::vector<ExtremeCase> discrete_cases(const MapAxis& axis);
/// Cells of the continuous model, planar and spatial.
[[nodiscard]] std::vector<ExtremeCase> continuous_cases(const MapAxis& axis);
/// All models' cells on the axis "turns".
[[nodiscard]] std::vector<ExtremeCase> turn_cases(const MapAxis& axis);

/// The axes "squares" and "cubes": predictions held against the tracked drops that the program carries.
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

}  // namespace clatter::validation::inline extremes
