// SPDX-License-Identifier: GPL-3.0-or-later
// Routh's construction: the path of an impact with Coulomb friction in impulse space.
#pragma once

#include "analytic/impact_law.hpp"

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
/// Number: double, or ImpactDual for derivatives (contact_impulse.hpp).
template <class Number>
[[nodiscard]] PathEnd<Number> coulomb_path(const PathCoefficients<Number>& path, const PathStart<Number>& start,
                                           const ImpactLaw& law);

}  // namespace clatter::analytic
