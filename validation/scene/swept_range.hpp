// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a swept quantity: from, to, and a step or a count.
#pragma once

#include <optional>
#include <string>

#include "validation/scene/argument.hpp"

namespace clatter::validation {

/// What is asked of a swept quantity.
struct RangeRequest {
  std::optional<double> from, to, step;
  std::optional<int> count;
};
/// @param what  the quantity, in words
[[nodiscard]] Arguments range_arguments(RangeRequest& request, const std::string& what);

struct Sweep {
  double from = 0;
  double to = 0;
  long long count = 0;
  double step = 0;  ///< 0: equal parts of [from, to]
  bool logarithmic = false;
  /// Value i.  With a step, from + i·step is rounded to 15 digits, so that steps that are decimal
  /// fractions give clean decimals; with a count, the last value is `to` exactly.
  [[nodiscard]] double value(long long i) const;
};
struct SweepDefault {
  double from, to, step;
};
/// @throws BadInput where an end lies outside `allowed`, or step and count are both given
[[nodiscard]] Sweep sweep_of(const RangeRequest& request, const SweepDefault& fallback, const Range& allowed);

}  // namespace clatter::validation
