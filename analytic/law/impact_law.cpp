// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/impact_law.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "analytic/base/errors.hpp"

namespace clatter::analytic {

using detail::refuse;

double ImpactLaw::most_friction() const { return friction == FrictionKind::none ? 0 : std::fabs(friction_value); }

void ImpactLaw::validate() const {
  if (!(restitution >= 0 && restitution <= 1)) {
    refuse("restitution", restitution, "between 0 and 1");
  }
  if (!std::isfinite(friction_value)) refuse("friction", friction_value, "finite");
  if (friction == FrictionKind::none && friction_value != 0) refuse("friction of no kind", friction_value, "0");
  if (has_cone() && !(friction_value >= 0)) refuse("friction", friction_value, "at least 0");
  if (friction == FrictionKind::moreau && law != RestitutionLaw::newton) {
    throw std::domain_error("friction at the end of an impact (Moreau): goes with Newton's restitution alone");
  }
  if (!(damping_per_stiffness >= 0 && std::isfinite(damping_per_stiffness))) {
    refuse("damping per stiffness", damping_per_stiffness, "at least 0 and finite");
  }
  if (law == RestitutionLaw::viscoelastic && restitution != 1) {
    refuse("restitution", restitution, "1 for the viscoelastic law");
  }
  const double square = ratio_direction.squaredNorm();
  if (!(std::fabs(square - 1) <= 16 * std::numeric_limits<double>::epsilon())) {
    refuse("length of the impulse ratio's direction", std::sqrt(square), "1");
  }
}

}  // namespace clatter::analytic
