// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a drop: flights and contacts in turn, without error estimates.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "numeric/body/body.hpp"
#include "numeric/drop/impact_record.hpp"
#include "numeric/drop/settings.hpp"
#include "numeric/drop/state_record.hpp"
#include "numeric/stepping/contact_run.hpp"

namespace clatter::numeric {

/// How finely a run is computed: an Accuracy put in figures.
struct Integration {
  Method method = Method::rk8pd;
  StepSettings steps;
  long evaluation_limit = 3'000'000;  ///< of the contact forces, at which the run ends
  double least_local_slip = 0;        ///< see ContactControl
  /// Tolerance of the contacts after an impact; null: that of `steps`.
  std::function<double(const ImpactRecord&)> next_tolerance = nullptr;
};

struct DropRun {
  std::vector<ImpactRecord> impacts;  ///< without errors
  Outcome outcome = Outcome::impact_limit;
  double end_time = 0;  ///< of what is listed or was reached [s]
  double step = 0;      ///< fixed step used [s]
  long force_evaluations = 0;
  long root_evaluations = 0;
  double energy_start = 0;                ///< [J]
  MotionState final_state, last_touch;    ///< at the end, and at the last touch-down
  double start_time = 0;                  ///< of the drop, after its first touch-down [s]
  std::vector<StateRecord> states;        ///< at Request::times, without errors
  long state_evaluations = 0;             ///< of the contact forces, for `states` and pieces of history
  bool impact_goes_on = false;            ///< whether the run has ended within an impact that is not listed
  MotionState reached;                    ///< of that, its last instant
  double reached_time = 0;                ///< [s]
  std::optional<GroundMotion> on_ground;  ///< how the last impact goes on, from `on_ground_from` [s]
  double on_ground_from = 0;
};

/// Takes from `request` the number of impacts, the times and the amplification; with error estimates, or
/// asked for alone, also ImpactRecord::local_slip.  Ends at once, without states, where a time lies before the start.
[[nodiscard]] DropRun run_drop(const Body& body, const World& world, const MotionState& start, const Request& request,
                               const Integration& integration, const Observer& observer);

}  // namespace clatter::numeric
