// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter sequence` says.
#pragma once

#include <vector>

#include "validation/output/report.hpp"
#include "validation/plan/sequence_method.hpp"

namespace clatter::validation::inline reports {

/// @param friction, loses  which columns tables have
[[nodiscard]] std::vector<Column> sequence_columns(bool friction = true, bool loses = true);
/// A row for each impact, and in tables and CSV one for the tail.
[[nodiscard]] Report sequence_report(const Scene& scene, const analytic::Drop& drop,
                                     const analytic::Sequence& sequence);
/// Of a drop in the plane or in space.
[[nodiscard]] Report sequence_report(const Scene& scene, const DiscreteRun& run);

}  // namespace clatter::validation::inline reports
