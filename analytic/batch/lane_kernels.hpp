// SPDX-License-Identifier: GPL-3.0-or-later
// The batch's kernels for the instruction sets of this processor.
#pragma once

#include <vector>

#include "analytic/batch/lanes.hpp"

namespace clatter::analytic::batch {

/// Those that run here, the widest first.  All do the same operations in the same order, none of them contracted, so
/// that their results agree bit for bit.
[[nodiscard]] const std::vector<KernelChoice>& kernels();

}  // namespace clatter::analytic::batch
