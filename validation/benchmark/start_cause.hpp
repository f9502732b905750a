// SPDX-License-Identifier: GPL-3.0-or-later
// What explains a run that starts, or is built, in another way than the problem says.
#pragma once

#include <vector>

#include "validation/benchmark/cause.hpp"

namespace clatter::validation {

/// Which part of the state at the start is another one: angle, spin or speed, or an angle in degrees.
/// @param left_after what flights and impacts after it leave
[[nodiscard]] std::vector<Cause> start_causes_of(const Motion& motion, const Reference& reference, double left_after);

/// Another length, thickness or radius of a planar body whose centre lies in its middle, by the height of its centre at
/// the first impact, if a step does not explain that; the moment of inertia is that of this size or the one asked for.
/// @param law_left law error of the impacts by the body asked for, which the size must explain
[[nodiscard]] std::vector<Cause> size_causes_of(const Motion& motion, const Reference& reference,
                                                const DeclaredLaw& law, const FoundImpact& first, double law_left);

}  // namespace clatter::validation
