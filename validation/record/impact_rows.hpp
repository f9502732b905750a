// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of impacts as columns and rows.
#pragma once

#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/record/impact_quantities.hpp"

namespace clatter::validation::inline record {

/// The columns of a model's quantities, then those of their errors as NAME_error.
/// @param shown names of the columns that tables have
template <class Impact>
[[nodiscard]] std::vector<Column> impact_columns(const std::vector<std::string>& shown);

/// What tables show of an impact's numbers.
struct ImpactDigits {
  int digits = 6;         ///< at most
  bool trusted = true;    ///< false: none is known
  bool estimated = true;  ///< false: errors were not asked for; two digits then
  Scales scales{};

  /// A number of this kind with its error.
  [[nodiscard]] Cell cell(double value, double error, Scale scale) const;
};
/// The cells of an impact under those columns.
template <class Impact>
[[nodiscard]] Row impact_row(const Impact& impact, const ImpactDigits& digits);
/// The same of the tail: its quantities under the columns of the discrete model.
[[nodiscard]] Row tail_row(const analytic::Tail& tail, const ImpactDigits& digits);

/// Appends the cells of an impact as CSV, each after a comma, under the columns of the kind of impacts `Columns`; what
/// an impact in the plane has no value of is left empty under the columns of one in space.
template <class Columns, class Impact>
void append_impact(std::string& out, const Impact& impact, bool with_errors);
/// The same of the tail, in the plane or in space.
template <class Columns, class AnyTail>
void append_tail(std::string& out, const AnyTail& tail, bool with_errors);

}  // namespace clatter::validation::inline record
