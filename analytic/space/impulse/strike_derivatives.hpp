// SPDX-License-Identifier: GPL-3.0-or-later
// How the impact of one point changes with the state before it.
//
// A turn δθ of the body at r, place and v = V + ω × r being those of impact.hpp, changes
//     δW = [δθ]× W − W [δθ]×,   δv = ω × (δθ × r),                                                     (1)
// and where the point is the lowest of a rim or ellipsoid, the turn also moves the place by δr; W and v change as (1)
// of impact.hpp says.  With δP from impulse_path.hpp, Δω = I⁻¹ (r × P),
//     δV′ = δV + δP/m,   δω′ = δω + δθ × Δω + I⁻¹ (r × (δP − δθ × P) + δr × P).                        (2)
#pragma once

#include "analytic/space/impulse/impact.hpp"

namespace clatter::analytic::space {

/// Rows: P, V′, ω′; columns: δθ, V, ω; world frame.
using StrikeDerivatives = Eigen::Matrix<double, 9, 9>;

/// How a small turn of the body moves the place where `point` (Corner::index) touches: r changes by δθ × r + S δθ.
/// Zero for a vertex; world frame [m/rad].  Domain: the rim that the point is does not lie level.
[[nodiscard]] Matrix3 shift_of_lowest_point(const Body& body, const Quaternion& attitude, int point);

/// (2) of a point that is no level rim, from `of_turns` and `of_velocity`.
[[nodiscard]] StrikeDerivatives strike_derivatives(const Body& body, const State& before, const Corner& corner,
                                                   const Vector3& impulse, const ImpulseSlopes& slopes);

/// strike() of a point that is no level rim, with its derivatives by (1) and (2): not finite where the path has none in
/// closed form (ImpulseSlopes).
/// Accuracy: 1e-10 of the size of each block, times what rounding does where slip nearly stops or starts.
/// Errors: as strike().
[[nodiscard]] Impact strike(const Body& body, const State& before, const ContactVelocity& velocity,
                            const Corner& corner, const ImpactLaw& law, StrikeDerivatives& derivatives);

}  // namespace clatter::analytic::space
