// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over the impacts of a run, with the errors that follow from those of the impacts.
#pragma once

#include <string>

#include "validation/run/run.hpp"

namespace clatter::validation {

/// Sums and extremes over the impacts listed; the normal impulse with that of the discrete model's tail.  Errors of
/// impacts may be correlated, so their sizes add up.  One impact that cannot be predicted leaves all unknown but the
/// first peak, if that is another impact's.
struct Totals {
  int impacts = 0;
  bool predictable = true;   ///< each impact is
  Estimated normal_impulse;  ///< [N·s]
  Estimated energy_loss;     ///< [J]
  Estimated last_start;      ///< touch-down of the last impact, after that of the first [s]
  Estimated first_peak;      ///< peak force of the first impact [N]; the continuous model's
  Estimated largest_peak;    ///< [N]; likewise
  Estimated largest_depth;   ///< greatest indentation [m]; likewise
};

[[nodiscard]] Totals totals(const Run& run);

/// Adds the sum of normal impulses, its error and whether all can be predicted to the fields of a run.
void add_totals(const Totals& sums, Value& fields);
/// The sum and its error as a comment of CSV.
[[nodiscard]] std::string totals_line(const Totals& sums);

}  // namespace clatter::validation
