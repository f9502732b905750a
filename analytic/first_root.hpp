// SPDX-License-Identifier: GPL-3.0-or-later
// The certified first root of a vertex's height: when the vertex reaches the ground.
//
// h″ = −g + ω² (p cos ωt + q sin ωt) of vertex_height.hpp (1) has zeros in closed form; they split
// the time axis into convex and concave pieces.  A concave piece reaches the ground if its end
// does, a convex one if its lowest point does, so that on each piece a root is bracketed or
// excluded.
#pragma once

#include <optional>

#include "analytic/vertex_height.hpp"

namespace clatter::analytic {

/// How near the closest approach without contact came.
struct NearMiss {
  double clearance = 0;  ///< least height at a turning point [m]; infinite: none
  double margin = 0;     ///< estimate of that height's rounding error [m]
  double time = 0;       ///< when [s]
  int vertex = 0;
  [[nodiscard]] bool within_margin() const { return !(clearance > margin); }
};

/// A first root, and what the search for it passed.
struct FirstRoot {
  std::optional<double> time;                ///< [s]; nothing: no root
  double bracket_low = 0, bracket_high = 0;  ///< certified bracket of the root [s]
  bool within_margin = false;                ///< the graze is so slight that rounding decides whether it happens
  NearMiss near_miss;                        ///< the lowest turning point that was passed above the ground
  int evaluations = 0;                       ///< of h or its derivatives
};

/// First root of h in (0, end], with h > 0 or a rising start at t = 0; nothing if there is none.
/// Proven first by the split into convex and concave pieces.  Whole turns during which the parabola
/// keeps the vertex above the ground, or on which h(t + 2π/ω) > h(t) > 0, are skipped, so 10⁶ turns
/// cost no more than two.
/// Accuracy: about 2 ulp × (1 + condition number).
/// @throws NumericalError if a root cannot be polished, or if no double tells the phase at which the
/// centre of mass comes down.
[[nodiscard]] FirstRoot first_root(const VertexHeight& height, double end);

}  // namespace clatter::analytic
