// SPDX-License-Identifier: GPL-3.0-or-later
// Coulomb friction spread over the length of a level edge that rebounds as a whole.
//
// With the edge at c + x l t from the centre of mass, −1 <= x <= 1, t its unit vector, m = ẑ × t, its motion is
//     v = (s_t, s_m, l ω_z, v_n, l ω·(t × ẑ)):   slip (v₁, v₂ + v₃ x), normal velocity v₄ + v₅ x,              (1)
// which impulses f = (F_t, F_m, ∫x dF_m, P, ∫x dP) change by G f.  In each dP the ground pushes with q(x) dP,
// q = max(0, a + b x), ∫q dx = 1, and rubs with −μ q d dP, d the direction of slip at x: df/dP = (−μ ∫q (d_t, d_m,
// x d_m), 1, x̄), x̄ = ∫x q.  The edge rebounds in step with P, its normal velocity staying in proportion to what it was,
//     v₄ + v₅ x = u φ(x),   φ = 1 at the pressure point without friction,                                        (2)
// which gives x̄; q is positive on a part of the edge alone where |x̄| > 1/3.  u ends by the restitution law, as that of
// a corner does, with the work −∫u φ(x̄) dP.  Slide and spin end together; then the edge sticks, or slip goes on.
//
// Where R = R₀ + S f, the x̄ that (2) asks for, is beyond an end while R₀, that without friction, is not, the ground
// pushes at
//     x̂ = R₀ + λ S f,   |x̂| <= 1,                                                                        (3)
// as on a face: λ <= 1 is the largest such that λ by the largest slip so far is no larger than before,
// and friction is that of the linear pressure with its centre at R₀ + λ² S f, no nearer to an end than η of the edge's
// half.  u goes on as if the push were at R, the couple of the rest, R − x̂, turns the edge out of (2), and the work
// counts φ(x̂).  An edge that sticks is pushed at the end that is nearest to R.  A solution of (3) goes on from the last
// one; where that one ends, it jumps.
#pragma once

#include <optional>

#include "analytic/space/impulse/impulse_path.hpp"

namespace clatter::analytic::space {

/// An edge as its impact sees it.
struct EdgeContact {
  using Vector = Eigen::Matrix<double, 5, 1>;
  using Matrix = Eigen::Matrix<double, 5, 5>;
  Matrix inverse_inertia = Matrix::Identity();  ///< G, symmetric positive definite [1/kg]
  Vector velocity = Vector::Zero();             ///< v; both ends approach [m/s]
  double velocity_scale = 0;                    ///< rounding errors of v are below 4ε × this [m/s]

  /// x of the pressure point that the edge has without friction; not within ±1 where pushes alone cannot do it.
  [[nodiscard]] double pressure_point() const;
  /// Whether friction at the pressure point keeps slip straight and the edge level, to rounding: it then strikes there
  /// as a corner does.
  [[nodiscard]] bool strikes_as_corner() const;
};

/// What the ground does to an edge.
struct EdgeImpulse {
  EdgeContact::Vector impulse = EdgeContact::Vector::Zero();  ///< f [N·s]
  PathKind path = PathKind::turning_slip;
  bool tilts = false;     ///< pushes could not keep to (2)
  double path_error = 0;  ///< of the impulse, relative, where pushes have come to an end of the edge
};

/// ∫q (d_t, d_m, x d_m) dx under the linear pressure of mean x̄.
/// Domain: |x̄| < 1, slip ≠ 0.  Accuracy: 1e-14.
[[nodiscard]] Vector3 rub_of_edge(const Vector3& slip, double pressure_point);

/// The impulse of an edge by Coulomb's law with μ > 0; nothing where R₀ is beyond the edge and (2) asks at any moment
/// for a pressure point there, or where slip takes too many steps: pressure jumps without end, or a point of the edge
/// that all but rests holds slip in one direction.  An edge that friction can hold sticks.
/// Accuracy: 1e-12 of the impulse; where pushes come to an end, EdgeImpulse::path_error.
[[nodiscard]] std::optional<EdgeImpulse> edge_impulse(const EdgeContact& edge, const ImpactLaw& law);

}  // namespace clatter::analytic::space
