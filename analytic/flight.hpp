// Free flight of a planar body between two impacts, and the earliest vertex to reach the ground.
//
// While the centre of mass moves on its parabola and the body turns at the constant rate Ω = σω, the
// height of a vertex is
//     h(t) = h₀ + v₀ t − g t²/2 + p (1 − cos ωt) + q (ωt − sin ωt),                              (1)
// h₀, v₀ its height and normal velocity at t = 0 and p = −d_n, q = σ d_t its offset there.  Written so,
// no term cancels for small angles.  h″ = −g + ω² (p cos ωt + q sin ωt) has zeros in closed form; they
// split the time axis into convex and concave pieces, on each of which the first root is bracketed.
#pragma once

#include <array>
#include <optional>

#include "analytic/planar_body.hpp"

namespace clatter::analytic {

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
    double scale = 0;     ///< sum of the magnitudes of the terms of h(t): its rounding error is below 4ε·scale
  };
  /// h and h′ of (1).  Accuracy: 4 ε × scale.
  [[nodiscard]] Value at(double t) const;
  /// h″(t).
  [[nodiscard]] double acceleration(double t) const;
  /// Sum of the magnitudes of the terms of h′(t), with the error of the angle turned: h′ is known to 4ε × this.
  [[nodiscard]] double velocity_scale(double t) const;
};

/// Everything that decides where the body goes after an impact.  Vertices in `touching` are at height
/// zero at t = 0 and do not count as arriving then, unless they approach.
struct Departure {
  double inclination = 0;  ///< α at t = 0 [rad]
  double sine = 0;         ///< of α
  double cosine = 1;       ///< of α
  double normal = 0;       ///< V_n of the centre of mass [m/s]
  double angular = 0;      ///< Ω [rad/s]
  double gravity = 0;      ///< g >= 0 [m/s²]
  VertexSet touching = 0;
  int reference = 0;        ///< a touching vertex
  double rebound_speed = 0; ///< normal velocity of the reference vertex, known exactly: e |u| [m/s]

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

/// How near the closest approach without contact came.
struct NearMiss {
  double clearance = 0;        ///< least height at a turning point [m]; infinite: none
  double margin = 0;           ///< estimate of that height's rounding error [m]
  double time = 0;             ///< when [s]
  int vertex = 0;
  [[nodiscard]] bool within_margin() const { return !(clearance > margin); }
};

/// Of each vertex, the lowest turning point that the search passed above the ground; infinite clearance: none.
using Passes = std::array<NearMiss, max_vertices>;

enum class FlightEnd {
  contact,        ///< `arrival` holds
  no_contact,     ///< nothing reaches the ground any more; `near_miss` holds
  stays_touching, ///< the reference vertex does not leave the ground: e|u| = 0 and no lift
};

struct Flight {
  FlightEnd end = FlightEnd::no_contact;
  Arrival arrival;
  NearMiss near_miss;
  int evaluations = 0;  ///< evaluations of (1) or its derivatives
};

/// Height function of `vertex` for a departure.
[[nodiscard]] VertexHeight vertex_height(const PlanarBody& body, const Departure& departure,
                                         int vertex);

/// Earliest time t > 0 at which a vertex reaches the ground.  Proven earliest by the split into convex
/// and concave pieces; whole turns during which the parabola keeps every vertex above the ground, or
/// on which h(t + 2π/ω) > h(t) > 0, are skipped, so 10⁶ turns cost no more than two.
/// Accuracy of time and inclination: about 2 ulp × (1 + condition number); the inclination keeps its
/// relative accuracy when it is small.
/// @param passes filled in if given.
/// @throws NumericalError if a root cannot be polished.
[[nodiscard]] Flight fly(const PlanarBody& body, const Departure& departure, Passes* passes = nullptr);

/// First root of (1) in (0, end], with h > 0 or a rising start at t = 0; nothing if there is none.
struct FirstRoot {
  std::optional<double> time;
  double bracket_low = 0, bracket_high = 0;
  bool within_margin = false;
  NearMiss near_miss;  ///< the lowest turning point that was passed above the ground
  int evaluations = 0;
};
[[nodiscard]] FirstRoot first_root(const VertexHeight& height, double end);

}  // namespace clatter::analytic
