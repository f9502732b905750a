// SPDX-License-Identifier: GPL-3.0-or-later
// One impact of a body in space at one corner: impulse and momentum with a restitution law and Coulomb friction.
//
// With r from the centre of mass to the corner, I the inertia in world axes and [r]× the matrix of the cross product,
// an impulse P on the corner changes the corner's velocity v = V + ω × r by
//     Δv = W P,   W = 1/m − [r]× I⁻¹ [r]×   (symmetric, positive definite).                          (1)
// While the corner slips in direction s and the normal impulse p grows,
//     dv/dp = W (n − μ s)   (Keller 1986; Bhatt and Koechling 1995).                                 (2)
#pragma once

#include "analytic/space/impulse/impulse_path.hpp"

namespace clatter::analytic::space {

/// An impulse and what it did.
struct Impact {
  Vector3 impulse = Vector3::Zero();         ///< P, world frame [N·s]
  Vector3 contact_before = Vector3::Zero();  ///< velocity of the corner before, world frame [m/s]
  Vector3 contact_after = Vector3::Zero();
  double approach_speed = 0;                         ///< of the corner; largest of a group [m/s]
  Vector3 velocity_after = Vector3::Zero();          ///< of the centre of mass, world frame [m/s]
  Vector3 angular_velocity_after = Vector3::Zero();  ///< world frame [rad/s]
  double compression_impulse = 0;                    ///< p_c, P_n at the end of compression [N·s]
  double slip_stop_impulse = 0;                      ///< P_n at which slip stops [N·s]; NaN if slip does not stop
  double least_slip = 0;                             ///< smallest slip during the impact [m/s]
  double energy_loss = 0;  ///< −P·(v + v′)/2 [J]; negative: Newton's law or an impulse ratio creates energy
  PathKind path = PathKind::frictionless;
  bool is_path_ambiguous = false;  ///< slip came so close to zero that rounding decides the kind of path

  /// Separation over approach speed as it came out; 0 without approach.
  [[nodiscard]] double restitution() const;
};

/// W of (1) at the corner `arm` = r [m]; all in one frame.
[[nodiscard]] Matrix3 inverse_contact_inertia(double mass, const Matrix3& inverse_inertia, const Vector3& arm);

/// Velocity of a corner, and the size of the parts that it was summed from: its rounding errors are below 4ε × scale.
struct ContactVelocity {
  Vector3 value = Vector3::Zero();  ///< world frame [m/s]
  double scale = 0;                 ///< |V| + |ω| |r| [m/s]
};
/// v = V + ω × r.
[[nodiscard]] ContactVelocity contact_velocity(const State& state, const Vector3& place);

/// The impact of the corner at `place` (body frame).  A corner that does not approach gets no impulse.  Coulomb's law
/// along its path: impulse_path.hpp.
/// Accuracy: 1e-13 of |P|, times what rounding of the state does.
/// @throws OutsideModelError where the law admits no bounded impulse; NumericalError where a number could not be had;
///         std::domain_error as ImpactLaw::validate().
[[nodiscard]] Impact strike(const Body& body, const State& before, const Vector3& place, const ImpactLaw& law);
/// The same with a velocity of the corner that is known better than V + ω × r is.
/// @param slopes  of the impulse, if asked for
[[nodiscard]] Impact strike(const Body& body, const State& before, const ContactVelocity& velocity,
                            const Vector3& place, const ImpactLaw& law, ImpulseSlopes* slopes = nullptr);

// How the impact of one point changes with the state before it.
//
// A turn δθ of the body, with the point at r and v = V + ω × r, changes
//     δW = [δθ]× W − W [δθ]×,   δv = ω × (δθ × r),                                                     (3)
// and where the point is the lowest of a rim or ellipsoid, the turn also moves the place by δr; W and v change as (1)
// says.  With δP from impulse_path.hpp, Δω = I⁻¹ (r × P),
//     δV′ = δV + δP/m,   δω′ = δω + δθ × Δω + I⁻¹ (r × (δP − δθ × P) + δr × P).                        (4)

/// Rows: P, V′, ω′; columns: δθ, V, ω; world frame.
using StrikeDerivatives = Eigen::Matrix<double, 9, 9>;

/// How a small turn of the body moves the place where `point` (Corner::index) touches: r changes by δθ × r + S δθ.
/// Zero for a vertex; world frame [m/rad].  Domain: the rim that the point is does not lie level.
[[nodiscard]] Matrix3 shift_of_lowest_point(const Body& body, const Quaternion& attitude, int point);

/// (4) of a point that is no level rim, from `of_turns` and `of_velocity`.
[[nodiscard]] StrikeDerivatives strike_derivatives(const Body& body, const State& before, const Corner& corner,
                                                   const Vector3& impulse, const ImpulseSlopes& slopes);

/// strike() of a point that is no level rim, with its derivatives by (3) and (4): not finite where the path has none in
/// closed form (ImpulseSlopes).
/// Accuracy: 1e-10 of the size of each block, times what rounding does where slip nearly stops or starts.
/// Errors: as strike().
[[nodiscard]] Impact strike(const Body& body, const State& before, const ContactVelocity& velocity,
                            const Corner& corner, const ImpactLaw& law, StrikeDerivatives& derivatives);

}  // namespace clatter::analytic::space
