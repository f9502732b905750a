// SPDX-License-Identifier: GPL-3.0-or-later
// Contact angles and impulses of the thin rod's first three impacts, an angle θ a row.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "analytic/plane/contact_angles.hpp"
#include "validation/output/report.hpp"
#include "validation/scene/named_texts.hpp"

namespace clatter::validation::inline reports {

/// What is asked for.
struct AnglesRequest {
  std::function<double(long long)> theta;  ///< of row i [°]
  long long count = 0;
  analytic::RodParameters rod;
  bool as_printed = false;  ///< also β by the paper's printed gravity term
  int digits = 6;           ///< shown in tables
};

/// From the flags of `clatter angles` by name: from, to, step, count, gravity_number, …, digits, as_printed.
/// @throws BadInput as the command.
[[nodiscard]] AnglesRequest angles_request(const NamedTexts& given);

/// Names, headings and units of a row's numbers.
[[nodiscard]] std::vector<Column> angles_columns(const AnglesRequest& request);
/// The numbers of a row in the order of the columns, the printed forms last.
using AnglesRow = std::array<double, 19>;
/// Row i; NaN for what does not happen with β, γ ≤ 90° and for what was not asked for.
[[nodiscard]] AnglesRow angles_row(const AnglesRequest& request, long long i);

/// The report without rows.
[[nodiscard]] Report angles_frame(const AnglesRequest& request);
/// A row for each angle, with the error of each number that is computed: a bound, as of contact_angles().
[[nodiscard]] Report angles_report(const AnglesRequest& request);
/// CSV of the rows from `begin` up to `end`; empty fields for what does not happen, and for errors that are not known.
[[nodiscard]] std::string angles_csv_rows(const AnglesRequest& request, long long begin, long long end);

}  // namespace clatter::validation::inline reports
