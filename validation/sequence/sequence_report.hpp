// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter sequence` says of a drop, in the plane or in space.
#pragma once

#include <vector>

#include "validation/output/report.hpp"
#include "validation/run/discrete_run.hpp"

namespace clatter::validation {

/// Columns in the plane.
/// @param friction, loses  which of them tables have
[[nodiscard]] std::vector<Column> sequence_columns(bool friction = true, bool loses = true);
/// A row for each impact, and in tables and CSV one for the tail.
/// @param tilts  how far the outcomes of small tilts are followed, which JSON lists and tables only sum up
[[nodiscard]] Report sequence_report(const PreparedScene& prepared, const DiscreteRun& found,
                                     const analytic::space::TiltEffort& tilts = {});
/// The text of that report, whose rows are written as they are made: a run of a million impacts needs no more memory
/// than the impacts.
void write_sequence(const PreparedScene& prepared, const DiscreteRun& found, const analytic::space::TiltEffort& tilts,
                    const TextStyle& style, const WriteText& write);

}  // namespace clatter::validation
