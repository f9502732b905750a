// SPDX-License-Identifier: GPL-3.0-or-later
// The impulse of one impact, and its derivatives.
#pragma once

#include "analytic/coulomb_path.hpp"
#include "analytic/detail/dual.hpp"

namespace clatter::analytic {

/// A number with its derivatives with respect to α, u, s and Ω before the impact.
using ImpactDual = detail::Dual<4>;

/// e of the law at this approach speed.
template <class Number>
[[nodiscard]] Number restitution_at(const ImpactLaw& law, const Number& approach_speed);

/// Impulse of a contact at one point, per unit mass: Eq. 8 for an impulse ratio, Routh's path for
/// Coulomb's law.  `path` holds A, B, B and C of impact_law.hpp (b).
/// @throws OutsideModelError if the impulse ratio is at or beyond the jamming limit.
template <class Number>
[[nodiscard]] PathEnd<Number> point_impulse(const PathCoefficients<Number>& path, const PathStart<Number>& start,
                                            const ImpactLaw& law);

/// Approach speed of the pressure centre of a body that lands flat,
///     u* = v + k² ω²/v,   v = −V_n > 0,
/// where the pushes that reverse V_n and ω together have their resultant, friction aside: at d_t = −k² ω/v.  The motion
/// of the face is that of a contact at this one point.
template <class Number>
[[nodiscard]] Number pressure_centre_speed(const Number& descent, const Number& turning, double gyration_square) {
  return descent + gyration_square * (turning / descent * turning);
}

/// Impulse of a flat landing, per unit mass.  The body's turning, which reverses in step with the
/// normal impulse, moves the face along the ground by ω d_n: a drift for the slip.
/// @param turning ω d_n [m/s]
template <class Number>
[[nodiscard]] PathEnd<Number> flat_impulse(const PathStart<Number>& start, const Number& turning, const ImpactLaw& law);

}  // namespace clatter::analytic
