// SPDX-License-Identifier: GPL-3.0-or-later
// What reports over a scene's sweep share.
#pragma once

#include <cstddef>

#include "validation/output/plot.hpp"
#include "validation/output/report.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// Column of the swept values, named like the quantity.
[[nodiscard]] Column swept_column(const SceneSweep& sweep);

/// The quantity in words, for an axis of a picture, without the unit.
[[nodiscard]] std::string swept_words(const SceneSweep& sweep);
/// Range of such an axis from the first to the last value; around a single one.
[[nodiscard]] Range2 swept_range(double first, double last);

/// Adds a note if fewer values than the sweep has are done.
void add_interruption(const SceneSweep& sweep, std::size_t done, Report& report);

}  // namespace clatter::validation
