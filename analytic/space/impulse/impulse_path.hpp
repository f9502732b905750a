// SPDX-License-Identifier: GPL-3.0-or-later
// The impulse of one corner with Coulomb friction: the path of Keller and Routh in impulse space.
//
// The path starts with slip or without, and has at most two parts:
//   slip      along a straight line, if its direction is invariant to rounding; otherwise slip that
//             turns (impulse_path.hpp)
//   after it  where slip has stopped, or was zero at the start: the corner sticks if |A⁻¹b| <= μ; otherwise slip goes
//             on in the direction s = (μA + f)⁻¹ b, f > 0, which is the one invariant direction that leads outwards.
// The normal impulse stays bounded for every μ: W is positive definite, so that dv_n/dp > μ f along an invariant
// direction and dv_n/dp = 1/(W⁻¹)_nn > 0 while sticking.  A corner that digs in (dv_n/dp <= 0) slows down, stops and
// goes on along one of these.
#pragma once

#include <array>

#include "analytic/law/impact_law.hpp"
#include "analytic/space/flight/body.hpp"

namespace clatter::analytic::space {

// A corner that strikes, the law by which it does, and its impulse.

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

/// The impulse of an approaching corner (v_n < 0) by `law`; Moreau's by its own rule.
/// Accuracy: 1e-13 of |P|, times what rounding of W and v does; 1e-10 of their size for the slopes.
/// @throws OutsideModelError for an impulse ratio at or beyond jamming, c + μ_i b·d <= 0; NumericalError if a number
///         overflows or a path cannot be resolved.
[[nodiscard]] ContactImpulse contact_impulse(const Contact& contact, const ImpactLaw& law,
                                             ImpulseSlopes* slopes = nullptr);

/// The same by Moreau's rule; a negative coefficient of friction acts along the slip.
[[nodiscard]] ContactImpulse moreau_impulse(const Contact& contact, double friction, double restitution);

/// A face that lands and rebounds as a whole: its normal motion goes over into −e times itself in step with the normal
/// impulse p, whatever friction does; where all of the face slips in one direction,
/// friction acts where the centre of mass is above the ground and slows the slip there,
///     dv_t/dp = drift + (dP_t/dp)/m,   du/dp = 1/m.
struct FaceContact {
  double mass = 1;                  ///< m [kg]
  double approach_speed = 1;        ///< −V_z > 0 [m/s]
  double restitution = 1;           ///< e
  Vector2 slip = Vector2::Zero();   ///< velocity along the ground of the point below the centre of mass [m/s]
  Vector2 drift = Vector2::Zero();  ///< how the reversal of the body's turning moves that point [1/kg]
  double velocity_scale = 0;        ///< as in Contact
};
/// P of the whole face; the restitution laws agree, since slip does not act on the normal motion.
/// Accuracy, errors: as contact_impulse().
[[nodiscard]] ContactImpulse face_impulse(const FaceContact& face, const ImpactLaw& law);

}  // namespace clatter::analytic::space
