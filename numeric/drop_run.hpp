// One run of a drop: flights and contacts in turn, without error estimates.
#pragma once

#include "numeric/options.hpp"
#include "numeric/stepping/contact_run.hpp"

namespace clatter::numeric {

/// How finely a run is computed.
struct Accuracy {
  Method method = Method::rk8pd;
  double tolerance = 1e-10;  ///< of an adaptive method
  double step_cap = 1;       ///< of an adaptive method: factor of the longest step, which no tolerance makes longer
  double step = 0;           ///< of a fixed-step method [s]; 0: see steps_per_contact
  double steps_per_contact = 300;
};

struct DropRun {
  std::vector<ImpactRecord> impacts;  ///< without errors
  Outcome outcome = Outcome::impact_limit;
  double end_time = 0;  ///< of what is listed or was reached [s]
  double step = 0;      ///< fixed step used [s]
  long force_evaluations = 0;
  long root_evaluations = 0;
  double energy_start = 0;  ///< [J]
  MotionState final_state;
};

/// What a run does besides.
struct RunExtras {
  bool amplification = false;
  bool local_slip = false;  ///< estimate ImpactRecord::local_slip
  HistoryRecorder* history = nullptr;
  const std::function<bool(int, long)>* progress = nullptr;
};

[[nodiscard]] DropRun run_drop(const Body& body, const Ground& ground, const MotionState& start, const Options& options,
                               const Accuracy& accuracy, const RunExtras& extras);

/// Translational + rotational + potential (m g z) energy [J].
[[nodiscard]] double mechanical_energy(const Body& body, const MotionState& state, double gravity);

}  // namespace clatter::numeric
