// SPDX-License-Identifier: GPL-3.0-or-later
// What explains impacts that do not follow the law: hypotheses with one number each, fitted to all of them.
#pragma once

#include <vector>

#include "validation/benchmark/cause.hpp"

namespace clatter::validation {

/// Restitution, friction, another law, inertia, levers, a restitution that is left out for slow contacts or acts at the
/// centre of mass, each by the exact map at the run's own state before an impact (Score::law).
/// @param gravity_of_step g × step of a code that does not resolve the instants, otherwise 0 [m/s]: errors that it
/// makes
///        are no evidence
[[nodiscard]] std::vector<Cause> impact_causes_of(const Reference& reference, const DeclaredLaw& law,
                                                  const std::vector<FoundImpact>& impacts, double gravity_of_step);

/// An inertia or levers so far off that no point of the body explains the jumps.
/// @pre the first of the impacts has no points
[[nodiscard]] std::vector<Cause> far_body_causes_of(const Answer& answer, const Reference& reference,
                                                    const DeclaredLaw& law, const std::vector<FoundImpact>& impacts);

}  // namespace clatter::validation
