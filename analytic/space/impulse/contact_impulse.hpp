// SPDX-License-Identifier: GPL-3.0-or-later
// A corner that strikes, the law by which it does, and its impulse.
#pragma once

#include <array>

#include "analytic/law/impact_law.hpp"
#include "analytic/space/flight/body.hpp"

namespace clatter::analytic::space {

/// How the corner moved along the ground during the impact.
enum class PathKind {
  frictionless,  ///< no tangential impulse asked for
  slip,          ///< slips along one straight line throughout (also: an impulse ratio as given)
  turning_slip,  ///< slips throughout, and the direction turns
  stick,         ///< no slip from the start
  slip_stick,    ///< slip stops, then sticks
  slip_reslip,   ///< slip stops, then goes on along the one outgoing invariant direction
};

/// A corner as its impact sees it.
struct Contact {
  Matrix3 inverse_inertia = Matrix3::Identity();  ///< W, symmetric positive definite [1/kg]
  Vector3 velocity = Vector3::Zero();             ///< v, world frame [m/s]
  double velocity_scale = 0;                      ///< rounding errors of v are below 4ε × this [m/s]
};

/// An impulse at the corner and what it did there.
struct ContactImpulse {
  Vector3 impulse = Vector3::Zero();         ///< P, world frame [N·s]
  Vector3 velocity_after = Vector3::Zero();  ///< v′, world frame [m/s]
  double compression_impulse = 0;            ///< as in Impact
  double slip_stop_impulse = 0;              ///< as in Impact
  double least_slip = 0;                     ///< as in Impact
  PathKind path = PathKind::frictionless;
  bool is_path_ambiguous = false;
};

/// How P changes with the contact, to first order; world frame.
struct ImpulseSlopes {
  std::array<Matrix3, 3> turns;  ///< given: δW for small turns of the body about x, y, z; about z that of W as a whole
  Matrix3 of_turns;              ///< ∂P for these, v kept [N·s/rad]
  /// ∂P/∂v [kg].  NaN, as of_turns, where P has no derivative or none in closed form: slip that starts from rest or
  /// keeps a direction from which it would turn if it left it, other than in a plane of symmetry.
  Matrix3 of_velocity;
};

}  // namespace clatter::analytic::space
