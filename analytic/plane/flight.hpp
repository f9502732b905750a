// SPDX-License-Identifier: GPL-3.0-or-later
// Free flight of a planar body between two impacts, and the earliest vertex to reach the ground.
#pragma once

#include <array>
#include <optional>

#include "analytic/base/angle.hpp"
#include "analytic/plane/body.hpp"

namespace clatter::analytic {

// Height of a vertex during free flight.
//
// While the centre of mass moves on its parabola and the body turns at the constant rate Ω = σω,
// the height of a vertex is
//     h(t) = h₀ + v₀ t − g t²/2 + p (1 − cos ωt) + q (ωt − sin ωt),                        (1)
// h₀, v₀ its height and normal velocity at t = 0 and p = −d_n, q = σ d_t its offset there.  Written
// so, no term cancels for small angles.  h = 0 for the other end of the unit rod is Eq. 12 of Shan
// et al. (2005); the gravity term printed there has another sign and half the size.

/// Coefficients of (1).
struct VertexHeight {
  double height = 0;    ///< h₀ >= 0 [m]
  double velocity = 0;  ///< v₀ [m/s]
  double gravity = 0;   ///< g [m/s²]; negative values (upwards) only for the paper's printed term
  double rate = 0;      ///< ω >= 0 [rad/s]
  double versine = 0;   ///< p [m]
  double sine = 0;      ///< q [m]

  struct Value {
    double height = 0;    ///< h(t)
    double velocity = 0;  ///< h′(t)
    /// Sum of the magnitudes of the terms of h(t): the rounding error of h is below 4ε × this.
    double scale = 0;
  };
  /// h and h′ of (1).  Accuracy: 4 ε × scale.
  [[nodiscard]] Value at(double t) const { return at(t, detail::Turn(rate * t)); }
  /// The same with the angle turned, rate × t, which all vertices share.
  [[nodiscard]] Value at(double t, const detail::Turn& turn) const;
  /// h″(t).
  [[nodiscard]] double acceleration(double t) const;
  /// Sum of the magnitudes of the terms of h′(t), with the error of the angle turned: h′ is known
  /// to 4ε × this.
  [[nodiscard]] double velocity_scale(double t) const;
};

// The certified first root of a vertex's height: when the vertex reaches the ground.
//
// h″ = −g + ω² (p cos ωt + q sin ωt) of (1) has zeros in closed form; they split
// the time axis into convex and concave pieces.  A concave piece reaches the ground if its end
// does, a convex one if its lowest point does, so that on each piece a root is bracketed or
// excluded.

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

// What the ends of a flight prove of a vertex between them, without a search.

/// Whether heights, velocities and curvatures at 0 and at `end` prove that h > 0 on (0, end] and that first_root()
/// would pass no turning point there: within half a turn the curvature changes its sign once at most.  False: they do
/// not.
/// @param turn rate × end
[[nodiscard]] bool stays_above(const VertexHeight& height, double end, const detail::Turn& turn);

/// Everything that decides where the body goes after an impact.  Vertices in `touching` are at height
/// zero at t = 0 and do not count as arriving then, unless they approach.
struct Departure {
  double inclination = 0;    ///< α at t = 0 [rad]
  double sine = 0;           ///< of α
  double cosine = 1;         ///< of α
  double normal = 0;         ///< V_n of the centre of mass [m/s]
  double angular = 0;        ///< Ω [rad/s]
  double gravity = 0;        ///< g >= 0 [m/s²]
  double gravity_along = 0;  ///< along x; it moves no vertex up or down [m/s²]
  VertexSet touching = 0;
  int reference = 0;         ///< a touching vertex
  double rebound_speed = 0;  ///< normal velocity of the reference vertex, known exactly: e |u| [m/s]

  /// d_j − d_i from vertex i of the body to vertex j, without the cancellation of parts that they share.
  [[nodiscard]] ContactPoint offset(const PlanarBody& body, int from, int to) const;
};

/// The moment at which the earliest vertex reaches the ground.
struct Arrival {
  double time = 0;         ///< since departure [s]
  double inclination = 0;  ///< α then, not reduced to one turn [rad]
  VertexSet vertices = 0;  ///< those that arrive together
  int vertex = 0;          ///< the first of them
  double bracket_low = 0;  ///< certified bracket of the root [s]
  double bracket_high = 0;
  bool within_margin = false;  ///< the graze is so slight that rounding decides whether it happens
};

/// The lowest turning point of each vertex that the search passed above the ground; infinite clearance: none.
using Passes = std::array<NearMiss, max_vertices>;

enum class FlightEnd {
  contact,         ///< `arrival` holds
  no_contact,      ///< nothing reaches the ground any more; `near_miss` holds
  stays_touching,  ///< the reference vertex does not leave the ground: e|u| = 0 and no lift
};

struct Flight {
  FlightEnd end = FlightEnd::no_contact;
  Arrival arrival;
  NearMiss near_miss;
  int evaluations = 0;  ///< of heights or their derivatives
};

/// Height function of `vertex` for a departure.
[[nodiscard]] VertexHeight vertex_height(const PlanarBody& body, const Departure& departure, int vertex);

/// Earliest time t > 0 at which a vertex reaches the ground, proven earliest by first_root().
/// Accuracy of time and inclination: about 2 ulp × (1 + condition number); the inclination keeps its
/// relative accuracy when it is small.
/// @param passes filled in if given.
/// @throws NumericalError if a root cannot be polished.
[[nodiscard]] Flight fly(const PlanarBody& body, const Departure& departure, Passes* passes = nullptr);

}  // namespace clatter::analytic
