// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies that move in the vertical plane and touch the ground with vertices.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace clatter::analytic {

/// Most vertices that a planar body has here.
inline constexpr int max_vertices = 4;

/// A contact vertex, given in the body frame: origin at the centre of mass, x from end a to end b,
/// z up when the body lies flat (inclination 0).
struct Vertex {
  double x = 0;  ///< [m]
  double z = 0;  ///< [m]
};

/// A set of vertices, one bit for each index: those that strike together.
using VertexSet = std::uint8_t;

/// Where a vertex is relative to the centre of mass, in the world frame (the paper's vector d).
struct ContactPoint {
  double tangential = 0;  ///< d_t, along x [m]
  double normal = 0;      ///< d_n, along z [m]; negative: below the centre of mass
};

/// A rigid body in the x–z plane.  Inertia enters as k² = I/m, so that m·L², which would overflow for
/// extreme masses and lengths, is never formed.  Lengths within 1e-150 … 1e150 m are safe.
struct PlanarBody {
  double mass = 1;             ///< m [kg]
  double gyration_square = 0;  ///< k² = I/m about the y axis through the centre of mass [m²]
  int vertex_count = 0;
  std::array<Vertex, max_vertices> vertices{};
  /// Uniform rod without thickness: 12 k² = L².  Its elastic sequences have closed forms, which
  /// are used where they apply.
  bool uniform_thin_rod = false;

  /// Largest distance of a vertex from the centre of mass [m].
  [[nodiscard]] double reach() const;
  /// I = m k² [kg·m²]; may overflow to infinity where the sequence itself does not.
  [[nodiscard]] double inertia() const;
  /// d of a vertex when the body is inclined by the angle of this sine and cosine (a lower: positive):
  ///     d_t = x cos α − z sin α,   d_n = x sin α + z cos α.
  [[nodiscard]] ContactPoint contact_point(int vertex, double sine, double cosine) const;
  /// "a", "b", "a-top", "b-top"; sets: "both" for {a, b}, otherwise names joined by "+".
  [[nodiscard]] static std::string vertex_set_name(VertexSet set);
};

struct RodSize {
  double mass = 1;    ///< [kg]
  double length = 1;  ///< [m]
  double radius = 0;  ///< [m]; 0: thin rod
};

struct BoxSize {
  double mass = 1;       ///< [kg]
  double length = 1;     ///< L, along the inclination [m]
  double width = 1;      ///< W, into the page [m]; does not enter the planar motion
  double thickness = 1;  ///< T, upright at inclination 0 [m]
};

/// Uniform rod: radius 0 gives the paper's thin rod (2 vertices, I = mL²/12), a positive radius the
/// solid cylinder with its rim (4 vertices at (±L/2, ±r), I = m(3r² + L²)/12).
/// Vertex order: a, b, a-top, b-top.
/// @throws std::domain_error naming the field, its value and what is allowed:
///         mass > 0, length > 0, radius >= 0, all finite.
[[nodiscard]] PlanarBody make_rod(const RodSize& size);

/// Uniform box: 4 vertices at (±L/2, ±T/2), I = m(L² + T²)/12.
/// @throws std::domain_error as make_rod; every size > 0 and finite.
[[nodiscard]] PlanarBody make_box(const BoxSize& size);

}  // namespace clatter::analytic
