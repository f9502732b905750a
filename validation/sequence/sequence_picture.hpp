// SPDX-License-Identifier: GPL-3.0-or-later
// An impact sequence as a picture.
#pragma once

#include "validation/output/picture.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/history_file.hpp"

namespace clatter::validation {

/// Heights over time, each flight in closed form, and the normal impulse of each impact at its time, as far as the
/// window goes: in the plane the heights of both ends and the impulses at each, in space those of the centre of mass
/// and the lowest point, and the impulses at each corner.
[[nodiscard]] Picture sequence_picture(const PreparedScene& prepared, const DiscreteRun& found,
                                       const TimeWindow& window);

}  // namespace clatter::validation
