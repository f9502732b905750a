// What accuracy costs: every model and method over its settings, on one scene.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/scene/simulation_scene.hpp"

namespace clatter::validation {

/// The models, from the cheapest to the one that leaves nothing out.
enum class Rung {
  closed_form,  ///< Eqs. 9 and 12: thin rod, no gravity, friction or damping; at most three impacts
  discrete,     ///< instantaneous impacts at the real corners, flights between them
  planar,       ///< continuous contact, kept in its plane
  spatial,      ///< continuous contact in three dimensions
};
[[nodiscard]] const char* rung_name(Rung rung);

/// One model with one setting on the scene.
struct TradePoint {
  Rung rung = Rung::spatial;
  std::string method;    ///< of the continuous models; empty otherwise
  int digits = 0;        ///< asked of an adaptive method; 0: fixed step or no method
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
};

struct TradeoffOptions {
  int least_repeats = 3;
  double least_seconds = 0.02;  ///< repeat until this much time has gone [s]
  /// Called with (done, of); return false to end early with the points so far.
  std::function<bool(std::size_t, std::size_t)> progress = nullptr;
};

/// The scene through every rung; the continuous ones with five methods over eleven tolerances or steps each, and over
/// mesh densities.  True values: the planar model (the spatial one for a tilted drop) by rk8pd at 12 digits; impacts
/// whose errors have grown beyond 1e-6 by then are left out.
/// Methods that fail are points with their reason.
[[nodiscard]] Tradeoff measure_tradeoff(const SimulationScene& scene, const TradeoffOptions& options);

}  // namespace clatter::validation
