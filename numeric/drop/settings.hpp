// SPDX-License-Identifier: GPL-3.0-or-later
// What a simulation is given besides a body and its start: the world, the request, the accuracy and an observer.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "numeric/contact/ground.hpp"
#include "numeric/drop/history.hpp"
#include "numeric/drop/impact_record.hpp"
#include "numeric/motion/motion_state.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

struct HistoryPiece;

/// What is simulated: the laws that hold around the body.
struct World {
  Ground ground = {};     ///< with its law of friction
  double gravity = 9.81;  ///< [m/s²], >= 0
  /// Slope of the ground [°], between −90 and 90: x points down the slope where it is positive.  Axes are those of the
  /// ground, z its normal, so that gravity has g sin along x and −g cos along z.
  double incline_deg = 0;
  /// Whether gravity acts during contacts too.  Without it a contact of time T is wrong by g T in speed, and the ledger
  /// by m g times the rise of the centre of mass.
  bool gravity_in_contact = true;
  bool planar = false;  ///< keep the motion in its x–z plane: no force or moment out of it acts
  /// Friction of a slipping contact in space acts at its pressure centre alone (FrictionLaw::coulomb), as if the patch
  /// were a point.  Otherwise slip varies over the patch with its spin about the vertical; what that changes vanishes
  /// with the patch as the ground becomes stiff, but a spinning patch that hardly slips takes very short steps.
  bool point_friction = false;

  [[nodiscard]] Gravity pull() const {
    if (incline_deg == 0) return gravity;
    const double slope = incline_deg * (std::numbers::pi / 180);
    return {gravity * std::cos(slope), gravity * std::sin(slope)};
  }
  /// @throws std::domain_error naming field, value and what is allowed.
  void validate() const;
};

/// What is asked for.
struct Request {
  int impacts = 6;  ///< most impacts to report, >= 1
  /// By a second run, at another tolerance or half the step, until it goes another way.
  bool error_estimates = true;
  bool amplification = true;  ///< growth of a small error of the start, by a neighbouring run
  /// ImpactRecord::local_slip however small it is.  Otherwise it comes with the error estimates, of those parts of
  /// contacts where the laws of friction may differ by more than 10^−digits of the contact's mean force.
  bool local_slip = false;
  bool local_slip_with_errors = true;  ///< false: only where asked for; it takes a tenth of the time
  /// Times of Simulation::states, ascending, not before the start nor after `until` [s after the first touch-down]. The
  /// run goes on past `impacts` until the last of them.
  std::vector<double> times = {};
  /// Whether the lowest point of the start may lie below the ground, which then presses from the beginning: times count
  /// from the start, and the body is in its first impact.  One that rests there has none.
  bool starts_on_ground = false;
  /// When the run ends at the latest [s after the first touch-down], >= 0; infinite: never.
  double until = std::numeric_limits<double>::infinity();

  /// @throws std::domain_error naming field, value and what is allowed.
  void validate() const;
};

/// Below it the rounding of a contact's state is as large as the local error.
inline constexpr double least_tolerance = 5e-14;

/// How well the numbers are to be computed, and with how much work at most.
struct Accuracy {
  Method method = Method::automatic;
  int digits = 6;   ///< significant digits wanted, 2 to 12
  double step = 0;  ///< of tvd_rk3 [s]; 0: chosen from `digits` and the estimated contact time
  /// An adaptive method holds local error <= tolerance × size, per step; from 5e-14 to 0.1, 0: 10^(−digits − 4).
  double tolerance = 0;
  long evaluation_limit = 3'000'000;  ///< of the contact forces, in the main run; then the run ends

  /// @throws std::domain_error naming field, value and what is allowed.
  void validate() const;
};

/// Who looks on, and may end the run.  Of the main run only.
struct Observer {
  HistoryRecorder history = nullptr;
  /// Takes the pieces of the history in the order of time: all steps of all contacts, and the flights between them
  /// (history_pieces.hpp).  Samples within steps count as force evaluations.
  std::function<void(const HistoryPiece&)> pieces = nullptr;
  /// Called now and then with (impacts so far, contact force evaluations so far); return false to end the run.
  std::function<bool(int, long)> progress = nullptr;
  /// Called with each impact, without its errors; return false to end the run with it.
  std::function<bool(const ImpactRecord&)> impact = nullptr;
};

}  // namespace clatter::numeric
