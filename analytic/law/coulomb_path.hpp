// SPDX-License-Identifier: GPL-3.0-or-later
// Routh's construction: the path of an impact with Coulomb friction in impulse space.
#pragma once

#include <functional>

#include "analytic/base/dual.hpp"
#include "analytic/law/impact_law.hpp"

namespace clatter::analytic {

/// Velocities of the contact along the normal impulse P (per unit mass), with r = dP_t/dP_n:
///     du/dP = normal − normal_coupling r,     ds/dP = tangential r − slip_drift.
template <class Number = double>
struct PathCoefficients {
  Number normal{1};
  Number normal_coupling{0};
  Number slip_drift{0};
  Number tangential{1};
};

/// Where the path starts, and the coefficient of restitution at that approach speed.
template <class Number = double>
struct PathStart {
  Number approach_speed{0};  ///< −u > 0 [m/s]
  Number slip{0};            ///< s [m/s]
  Number restitution{1};     ///< e
};

/// Where it ends, per unit mass.
template <class Number = double>
struct PathEnd {
  Number normal_impulse{0};      ///< [m/s]
  Number tangential_impulse{0};  ///< [m/s]
  /// u at the end, from where u was 0: however small beside the approach [m/s]
  Number separation_speed{0};
  ImpactMode mode = ImpactMode::frictionless;
};

/// Impulse of a contact with Coulomb's coefficient `law.friction_value`.  The path has at most two
/// straight phases: slip against r = −μ sign(s) until it stops, then sticking (r =
/// drift/tangential) if μ suffices, else slip the other way.  The end is where the restitution law
/// says, in closed form. Slip that would jam (du/dP <= 0) is always slowed down by the same
/// friction, so it stops and the path goes on: Coulomb's law has a solution for every μ >= 0.
/// Derivatives at s = 0 are those for an s that is then stopped.
/// Number: double, or ImpactDual for derivatives (coulomb_path.hpp).
template <class Number>
[[nodiscard]] PathEnd<Number> coulomb_path(const PathCoefficients<Number>& path, const PathStart<Number>& start,
                                           const ImpactLaw& law);

// The impulse of one impact, and its derivatives.

/// A number with its derivatives with respect to α, u, s and Ω before the impact.
using ImpactDual = detail::Dual<4>;

/// e of the law at this approach speed.
template <class Number>
[[nodiscard]] Number restitution_at(const ImpactLaw& law, const Number& approach_speed);

/// Impulse of a contact at one point, per unit mass: Eq. 8 for an impulse ratio, Routh's path for
/// Coulomb's law, the cone at the end for Moreau's.  `path` holds A, B, B and C of impact.hpp (b).
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

/// The largest restitution up to e with which a landing as a whole loses energy or none: e itself, unless `loss` is
/// less than zero there.  A smaller e ends the same path in impulse space earlier, so that the loss is a continuous
/// function of it, and so is what is found of the motion before.  0 if nothing is lost then, either.
/// Accuracy: the loss is between zero and 1e-13 of `energy`, or rounding of `loss`.
/// @param energy  before the landing; a gain of its rounding is none
/// @param loss  of energy, as a function of the restitution
[[nodiscard]] double restitution_without_gain(double e, double energy, const std::function<double(double)>& loss);

}  // namespace clatter::analytic
