// SPDX-License-Identifier: GPL-3.0-or-later
// Where a foreign run begins, beside the drop that is asked for.
#pragma once

#include <string>

#include "validation/benchmark/motion.hpp"

namespace clatter::validation {

/// By how much a planar body is turned with end a low, phi of a motion without whole turns [rad].
[[nodiscard]] double inclination_of(const analytic::space::State& state);

/// The state in which the drop that is asked for has its centre of mass at a height [m], on its way down to the touch.
[[nodiscard]] analytic::space::State asked_at_height(const Reference& reference, double height);

/// What of the first row is not as asked: "phi is 25 rad, must be 0.436332 rad", by the start that is nearest to it,
/// one of Reference::gaps or at the row's own height; empty where all of it is as there.
[[nodiscard]] std::string start_differences(const Motion& motion, const Reference& reference);

}  // namespace clatter::validation
