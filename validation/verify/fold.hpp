// SPDX-License-Identifier: GPL-3.0-or-later
// The fold at which the second impact ends, from its defining equations alone.
#pragma once

namespace clatter::validation::inline verify {

/// θ* at which the other end grazes the ground: sin θ + K φ − sin(φ − θ) = 0 and cos(φ − θ) = K with
/// K = (1 − 3c²)/(6c), φ = θ + β (Eq. 12 and its derivative).  By bisection in long double.
[[nodiscard]] double second_impact_fold();
/// β* = arccos K there.
[[nodiscard]] double second_impact_fold_beta();

}  // namespace clatter::validation::inline verify
