// What a simulation is asked for.
#pragma once

#include <functional>

#include "numeric/history.hpp"
#include "numeric/stepping/method.hpp"

namespace clatter::numeric {

/// What the user wants computed, and how.
struct Options {
  Method method = Method::automatic;
  double step = 0;      ///< of tvd_rk3 [s]; 0: chosen from `digits` and the estimated contact time
  int digits = 6;       ///< significant digits wanted, 2 to 12
  int impacts = 6;      ///< most impacts to report, >= 1
  bool planar = false;  ///< keep the motion in its x–z plane: no force or moment out of it acts
  double gravity = 9.81;       ///< [m/s²], >= 0
  long evaluation_limit = 3'000'000;  ///< of the contact forces, in the main run; then the run ends
  bool error_estimates = true;        ///< by a second run, at a coarser tolerance or half the step
  bool amplification = true;          ///< by a neighbouring run
  HistoryRecorder* history = nullptr;       ///< takes the time history, if any
  /// Called now and then with (impacts so far, contact force evaluations so far); return false to end the run.
  std::function<bool(int, long)> progress = nullptr;

  /// @throws std::domain_error naming field, value and what is allowed.
  void validate() const;
};

}  // namespace clatter::numeric
