// SPDX-License-Identifier: GPL-3.0-or-later
// What infinitely many impacts and contacts that last take from a drop, beside the impacts that are listed.
#pragma once

#include <optional>

#include "validation/output/estimated.hpp"
#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {

/// The energy that a drop loses in all impacts and in the contacts that its sequence follows [J]: what it has before
/// the first less what it is left with at the end of the last, of a body that has come to rest m g h of what it lies
/// on. Its error is not known where the end is not, nor on sloping ground.  None: the impacts listed are all.
[[nodiscard]] std::optional<Estimated> energy_lost_with_tail(const DiscreteDrop& drop,
                                                             const DiscreteSequence& sequence);

}  // namespace clatter::validation
