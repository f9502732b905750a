// SPDX-License-Identifier: GPL-3.0-or-later
// Contact angles and impulses of the thin rod's first three impacts, an angle θ a row.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "analytic/plane/contact_angles.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/rod/rod_parameters.hpp"

namespace clatter::validation {

/// What may be given.
struct AnglesOptions {
  RangeRequest range;  ///< of θ [°]
  RodRequest rod;
  bool as_printed = false;
  int digits = 6;
};
[[nodiscard]] Arguments angles_arguments(AnglesOptions& options);

/// What is asked for.
struct AnglesRequest {
  std::function<double(long long)> theta;  ///< of row i [°]
  long long count = 0;
  analytic::RodParameters rod;
  std::string rod_words{};  ///< as rod_summary()
  bool as_printed = false;  ///< also β by the paper's printed gravity term
  int digits = 6;           ///< shown in tables
};

/// @throws BadInput as sweep_of() and rod_parameters()
[[nodiscard]] AnglesRequest angles_request(const AnglesOptions& options);

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

// Contact angles and impulses over θ as a picture.

/// β and γ (or β beside its printed forms) and the impulses over θ.  Of more than 4000 rows every n-th is drawn, and
/// both rows between which an impact begins or ceases to happen, so that the branches end where they do.
[[nodiscard]] Picture angles_picture(const AnglesRequest& request);

}  // namespace clatter::validation
