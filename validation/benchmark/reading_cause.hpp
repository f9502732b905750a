// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a foreign run that are right when read otherwise.
#pragma once

#include <vector>

#include "validation/benchmark/cause.hpp"

namespace clatter::validation {

/// The ways to read an answer's rows by which all of it is right: other signs, axes, units and frames, and of a list
/// other ends.
[[nodiscard]] std::vector<Cause> misreadings_of(const Answer& answer, const Reference& reference, const Score& score);
/// Velocities that are those of the row before, if all is right with those of the next.
[[nodiscard]] std::vector<Cause> late_velocities_of(const Answer& answer, const Reference& reference,
                                                    const Score& score);

}  // namespace clatter::validation
