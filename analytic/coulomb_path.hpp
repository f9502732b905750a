// Routh's construction: the path of an impact with Coulomb friction in impulse space.
#pragma once

#include "analytic/impact_law.hpp"

namespace clatter::analytic {

/// Velocities of the contact along the normal impulse P (per unit mass), with r = dP_t/dP_n:
///     du/dP = normal − normal_coupling r,     ds/dP = tangential r − slip_drift.
struct PathCoefficients {
  double normal = 1;
  double normal_coupling = 0;
  double slip_drift = 0;
  double tangential = 1;
};

/// Where the path starts.
struct PathStart {
  double approach_speed = 0;  ///< −u > 0 [m/s]
  double slip = 0;            ///< s [m/s]
};

/// Where it ends, per unit mass.
struct PathEnd {
  double normal_impulse = 0;      ///< [m/s]
  double tangential_impulse = 0;  ///< [m/s]
  double separation_speed = 0;    ///< u at the end, from where u was 0: however small beside the approach [m/s]
  ImpactMode mode = ImpactMode::frictionless;
};

/// Impulse of a contact with Coulomb's coefficient `law.friction_value`.  The path has at most two
/// straight phases: slip against r = −μ sign(s) until it stops, then sticking (r = drift/tangential) if
/// μ suffices, else slip the other way.  The end is where the restitution law says, in closed form.
/// Slip that would jam (du/dP <= 0) is always slowed down by the same friction, so it stops and the
/// path goes on: Coulomb's law has a solution for every μ >= 0.
[[nodiscard]] PathEnd coulomb_path(const PathCoefficients& path, const PathStart& start,
                                   const ImpactLaw& law);

}  // namespace clatter::analytic
