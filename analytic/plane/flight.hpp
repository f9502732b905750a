// SPDX-License-Identifier: GPL-3.0-or-later
// Free flight of a planar body between two impacts, and the earliest vertex to reach the ground.
//
// While the centre of mass moves on its parabola and the body turns at the constant rate Ω, each
// vertex has the height of first_root.hpp; first_root.hpp finds where that vanishes first.
#pragma once

#include <array>

#include "analytic/plane/body.hpp"
#include "analytic/plane/first_root.hpp"

namespace clatter::analytic {

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
