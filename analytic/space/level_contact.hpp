// SPDX-License-Identifier: GPL-3.0-or-later
// A level face or edge that lands, wherever in it the ground has to push: the law of which a rebound as a whole
// (face_friction.hpp, edge_friction.hpp) is the case in which the pressure stays inside.
//
// With lengths in units ℓ from the middle c of the region C, x = (ξ, η) in C, the motion is
//     v = (U_x, U_y, ℓω_z, n₀, n_ξ, n_η):   slip U + ℓω_z ẑ × x, normal velocity n(x) = n₀ + n_ξ ξ + n_η η,          (1)
// which impulses f = (F_x, F_y, K/ℓ, P, X/ℓ) change by G f.  Before the impact n(x) = −φ(x), φ > 0 on C.  In each dP
// the ground pushes at a mean place x̂ of C, by which friction is given; x̂ and the rate κ of progress λ are those with
//     dn/dP (x) >= κ φ(x) on C,   equal where the ground pushes, at x̂ and around it;   dλ/dP = κ.                    (2)
// Where some pressure makes all of C rise in step with φ, that is the rebound as a whole.  Elsewhere the ground pushes
// at the side or corner of C that is nearest in the metric of the kinetic energy, the other points rise faster, and
// they keep what they have gained.  Since then n(x) >= λ φ(x), no point of C approaches after the impact.  λ goes from
// −1 to its end by the restitution law, as the normal velocity of a corner does: to e by Newton's.  Without friction
// this is the least change of velocity, in the metric of the kinetic energy, with n(x) >= e φ(x).
//
// Pressure inside a face is linear without tension (face_friction.hpp).  As x̂ comes to a side, that becomes pressure
// (a + b s)² along the side, and at a corner pressure there alone.  So x̂, and what the ground does, change continuously
// with the direction of slip, μ, the depth of the ground and φ.  That a corner rubs as a small disc does, 1/100 of C,
// lets slip end there while the body turns about it.
#pragma once

#include "analytic/space/contact_area.hpp"
#include "analytic/space/impulse_path.hpp"

namespace clatter::analytic::space {

struct LevelContact {
  using Vector = Eigen::Matrix<double, 6, 1>;
  using Matrix = Eigen::Matrix<double, 6, 6>;
  Matrix inverse_inertia = Matrix::Identity();  ///< G, symmetric positive definite [1/kg]
  Vector velocity = Vector::Zero();             ///< v; all of C approaches [m/s]
  /// C in units ℓ from c: a polygon counter-clockwise, two ends of an edge, or a disc of radius 1.
  ContactArea area;
  Vector2 below = Vector2::Zero();  ///< the centre of mass: there an impulse ratio acts on a face, units ℓ from c
  double velocity_scale = 0;  ///< rounding errors of v are below 4ε × this [m/s]
};

struct LevelImpulse {
  LevelContact::Vector impulse = LevelContact::Vector::Zero();         ///< f [N·s]
  LevelContact::Vector velocity_after = LevelContact::Vector::Zero();  ///< [m/s]
  PathKind path = PathKind::frictionless;
};

/// The impulse of a level contact by (2).
/// Accuracy: 1e-12 of the impulse; where x̂ comes nearer to a side than 1/300 of C, friction is that of the side.
/// @throws NumericalError if slip cannot be followed to its end, std::domain_error for an impulse ratio on an edge,
///         OutsideModelError for one that jams
[[nodiscard]] LevelImpulse level_impulse(const LevelContact& contact, const Law& law);

}  // namespace clatter::analytic::space
