// SPDX-License-Identifier: GPL-3.0-or-later
// What the cells of the models, those of very many turns, the tracked drops and the long runs compute, and how each
// number is judged.
#pragma once

#include <functional>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/plane/sequence.hpp"
#include "numeric/simulate.hpp"
#include "validation/evidence/extremes.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {

/// The sequence of a drop in the plane or in space; its outcome, time and evaluations go to `measure`.
/// @throws analytic::NumericalError if a number of it could not be computed, OutsideModelError if an impact jams.
[[nodiscard]] auto timed_sequence(const auto& drop, const analytic::SequenceOptions& options, CellMeasure& measure) {
  decltype(impact_sequence(drop, options)) sequence;
  measure.seconds = timed([&] { sequence = impact_sequence(drop, options); });
  if (sequence.outcome == analytic::Outcome::not_computed) throw analytic::NumericalError(sequence.message);
  if (sequence.outcome == analytic::Outcome::outside_model) throw analytic::OutsideModelError(sequence.message);
  measure.outcome = outcome_name(sequence.outcome);
  measure.evaluations = sequence.root_evaluations;
  return sequence;
}

/// Cells of the closed form and of the discrete model on an axis; none if it has no such quantity.
[[nodiscard]] std::vector<ExtremeCase> discrete_cases(const MapAxis& axis);
/// Cells of the continuous model, planar and spatial, on an axis; none if it has no such quantity.
[[nodiscard]] std::vector<ExtremeCase> continuous_cases(const MapAxis& axis);

/// All models' cells on the axis "turns".
[[nodiscard]] std::vector<ExtremeCase> turn_cases(const MapAxis& axis);

/// The axes "disc", "needle", "slenderness", "bounces" and "hops": round bodies of the discrete model in space, and how
/// their bouncing ends.
[[nodiscard]] std::vector<ExtremeCase> rim_cases(const MapAxis& axis);

/// The axes "squares" and "cubes": predictions held against the tracked drops that the program carries, to see where a
/// rigid body that strikes with one corner stops describing them.
[[nodiscard]] std::vector<ExtremeCase> measured_cases(const MapAxis& axis);

// Drops of the continuous model.

/// A box (the paper's phone unless said otherwise) and the ground that it falls on.
struct ContinuousCase {
  numeric::Vector3 size{0.10566, 0.04394, 0.01905};  ///< [m]
  double mass = 0.08814;                             ///< [kg]
  numeric::Ground ground = {};
  double angle_deg = 10;
  numeric::Vector3 velocity{0, 0, -1};  ///< at the touch [m/s]
  double gravity = 0;                   ///< [m/s²]
  int impacts = 2;
  long evaluation_limit = 100'000;  ///< of contact forces: some tenths of a second
};

/// How it is run.
struct ContinuousRun {
  bool planar = false;
  numeric::Method method = numeric::Method::automatic;
  int digits = 6;
  bool estimates = true;  ///< of the errors, by a second run
};

/// Asked now and then during a run; false ends it.
using GoesOn = std::function<bool()>;

[[nodiscard]] numeric::Simulation run_case(const ContinuousCase& scene, const ContinuousRun& how,
                                           const GoesOn& goes_on);

/// Energy that the ledger of an impact has lost or found, over the first energy: the largest.
[[nodiscard]] double worst_ledger_gap(const numeric::Simulation& run);
/// An elastic drop of the phone under gravity through many impacts: the energy after an impact against the first, the
/// largest difference over the first.  @throws EndedEarly
[[nodiscard]] CellMeasure kept_energy(int impacts, long evaluation_limit, bool planar, const GoesOn& goes_on);

/// @param goes_on asked now and then; false ends the cell early
[[nodiscard]] std::vector<ExtremeCase> long_cases(const LongRuns& runs, const GoesOn& goes_on);

}  // namespace clatter::validation
