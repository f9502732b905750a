// SPDX-License-Identifier: GPL-3.0-or-later
// An impact sequence as a picture.
#pragma once

#include "analytic/plane/sequence.hpp"
#include "validation/figures/picture.hpp"
#include "validation/record/time_window.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline reports {

/// Heights of both ends over time, each flight in closed form, and the normal impulse of each impact at its time, as
/// far as the window goes.
[[nodiscard]] Picture sequence_picture(const Scene& scene, const analytic::Sequence& sequence,
                                       const TimeWindow& window);

}  // namespace clatter::validation::inline reports
