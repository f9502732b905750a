// SPDX-License-Identifier: GPL-3.0-or-later
// Impact sequences of which nobody asks for more than sums.
#pragma once

#include "analytic/plane/impact_rows.hpp"

namespace clatter::analytic {

/// impact_sequence() of plane/sequence.hpp, without what no sum over the rows needs: their amplification and all errors
/// but `predictable`, `relative` and those of start, contact angle, normal impulse and energy loss.
[[nodiscard]] Sequence summed_sequence(const Drop& drop, const SequenceOptions& options);

}  // namespace clatter::analytic
