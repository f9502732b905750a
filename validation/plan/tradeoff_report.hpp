// SPDX-License-Identifier: GPL-3.0-or-later
// Cost against error: `clatter plan --tradeoff`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/plan/model_hierarchy.hpp"

namespace clatter::validation {

// What accuracy costs: every model and method over its settings, on one scene.

/// One model with one setting on the scene.
struct TradePoint {
  ModelLevel level = ModelLevel::spatial;
  std::string method;    ///< of the continuous models; empty otherwise
  double tolerance = 0;  ///< relative, per step, of an adaptive method; 0: fixed step or no method
  double step = 0;       ///< of tvd-rk3 [s]; 0: none
  std::string mesh;      ///< "paper's", "8 sectors", "4 x 4 x 4 unmerged" …
  double seconds = 0;    ///< least wall time of the repeated runs [s]
  long evaluations = 0;  ///< of the contact force
  int repeats = 0;
  double error = 0;     ///< true error: largest over impacts and numbers, relative to the sequence's sizes
  std::string failure;  ///< why there is no error; empty: there is
  bool pareto = false;  ///< nothing else is both cheaper and more accurate
};

struct Tradeoff {
  std::vector<TradePoint> points;
  std::string reference;       ///< how the true values were had
  double reference_error = 0;  ///< their estimated error, relative
  int impacts = 0;             ///< that were compared
  std::string shortfall;       ///< why the reference has fewer than asked for or fewer digits than required; else empty
};

struct TradeoffOptions {
  int least_repeats = 3;
  double least_seconds = 0.02;  ///< repeat until this much time has gone [s]
  /// Called with (done, of); return false to end early with the points so far.
  std::function<bool(std::size_t, std::size_t)> progress = nullptr;
};

/// The scene through every level; the continuous ones with four adaptive methods over thirteen tolerances and the
/// paper's over eleven steps, and over mesh densities.  True values: see true_values().
/// Methods that fail are points with their reason.
/// @throws numeric::NumericalError if the scene has no impact with a reference that can be trusted.
[[nodiscard]] Tradeoff measure_tradeoff(const Scene& scene, const TradeoffOptions& options);

/// A row for each point; in tables the front, which nothing beats in both cost and error.
[[nodiscard]] Report tradeoff_report(const Scene& scene, const Tradeoff& tradeoff);

}  // namespace clatter::validation
