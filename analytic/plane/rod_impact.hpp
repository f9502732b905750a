// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's closed forms for the unit rod (m = L = 1, v_n = −1, ω = 0): Eqs. 9 and 11.
//
// These stand apart from impact.hpp, which is tested against them.
#pragma once

#include "analytic/base/angle.hpp"
#include "analytic/plane/impact.hpp"

namespace clatter::analytic {

/// Velocity and normal impulse after an impact of the unit rod [m/s, rad/s, N·s].
struct RodImpact {
  PlanarVelocity after;
  double normal_impulse = 0;
};

struct RodApproach {
  double normal = -1;     ///< v_n < 0 [m/s]
  double tangential = 0;  ///< v_t [m/s]
};

/// Eq. 9 for any e, with Ω in the sign of Eq. 8 (the paper prints the other):
///     D   = 1 + 3c² − 3 μ_i s c
///     P_n = −(1+e) v_n/D,   V_n = −(e − 3c² + 3 μ_i s c) v_n/D,
///     V_t = v_t + μ_i P_n,  Ω   = −6 (1+e) (c − μ_i s) v_n/D.
/// θ = 0 gives the limit of a point contact, not the flat landing.
/// @throws OutsideModelError if D <= 0 (jamming).
[[nodiscard]] RodImpact rod_impact(const Angle& theta, const RodApproach& before, double restitution,
                                   double impulse_ratio);

/// Eq. 11 for any e: flat landing, V_n = −e v_n, V_t = v_t + μ_i P_n, P_n = −(1+e) v_n, Ω = 0.
[[nodiscard]] RodImpact flat_rod_impact(const RodApproach& before, double restitution, double impulse_ratio);

}  // namespace clatter::analytic
