// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of impacts as columns and rows.
#pragma once

#include <string>
#include <vector>

#include "validation/output/cells.hpp"
#include "validation/output/report.hpp"
#include "validation/run/impact_quantities.hpp"

namespace clatter::validation {

/// The columns of a model's quantities, then those of their errors as NAME_error.
/// @param shown names of the columns that tables have
[[nodiscard]] std::vector<Column> impact_columns(RunModel model, const std::vector<std::string>& shown);

/// What tables show of an impact's numbers.
struct ImpactDigits {
  int digits = 6;         ///< at most
  bool trusted = true;    ///< false: none is known
  bool estimated = true;  ///< false: errors were not asked for; two digits then
  Scales scales{};

  /// A number of this kind with its error.
  [[nodiscard]] Cell cell(double value, double error, Scale scale) const;
};
/// Sizes of the numbers of a run of the discrete model, against which a number counts as zero.
/// @param reach  largest distance of a corner from the centre of mass: a body that does not turn has a size of rates,
///               too, that of its speed over this [m]
[[nodiscard]] Scales scales_of(const Run& run, double reach);
/// The cells of an impact under the columns of its model, or of a tail, which leaves empty what no tail knows.
[[nodiscard]] Row impact_row(const Impact& impact, RunModel model, const ImpactDigits& digits);

/// An impact, or a tail, in rows that are written by the million.
struct ImpactText {
  RunModel model, columns;  ///< of the impact, and of the columns: one in the plane may stand under those of space
  bool errors = true;       ///< whether they were asked for; else they are left empty, as is `predictable`
};
/// Appends the cells; what the impact has no value of is left empty.
void append_impact(CellWriter& out, const Impact& impact, const ImpactText& text);

}  // namespace clatter::validation
