// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of the continuous model: a drop, how far its numbers are from others, and what each cell runs.
#pragma once

#include <functional>
#include <string>

#include "numeric/simulate.hpp"
#include "validation/evidence/cell.hpp"

namespace clatter::validation {

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

/// The same run as what a cell shows: ends early by exception.
/// @throws EndedEarly for any outcome but no-further-impact, impact-limit and at-rest, or without an impact.
[[nodiscard]] numeric::Simulation require_case(const ContinuousCase& scene, const ContinuousRun& how,
                                               const GoesOn& goes_on, CellMeasure& measure);

/// Powers of two by which the units of a scene have been multiplied.
struct UnitScale {
  double length = 1, mass = 1, time = 1;
};
[[nodiscard]] ContinuousCase scaled(const ContinuousCase& scene, const UnitScale& scale);

/// Worst difference of the impacts' numbers, each relative to the size of its kind at the impact, and the largest
/// error estimate of `run` in the same measure: starts, durations, impulses, peak forces, velocities, energies.
struct RunDistance {
  double error = 0;
  double estimate = 0;  ///< infinite if the model says that it does not know
};
/// @param run in units multiplied by `scale`; @param truth in units of 1
[[nodiscard]] RunDistance distance_of(const numeric::Simulation& run, const numeric::Simulation& truth,
                                      const UnitScale& scale, double radius);

/// Energy that the ledger of an impact has lost or found, over the first energy: the largest.
[[nodiscard]] double worst_ledger_gap(const numeric::Simulation& run);
/// An elastic drop of the phone under gravity through many impacts: the energy after an impact against the first, the
/// largest difference over the first.  @throws as require_case()
[[nodiscard]] CellMeasure kept_energy(int impacts, long evaluation_limit, bool planar, const GoesOn& goes_on);

/// Cells of the continuous model, planar and spatial, on an axis; none if it has no such quantity.
[[nodiscard]] std::vector<ExtremeCase> continuous_cases(const MapAxis& axis);

}  // namespace clatter::validation
