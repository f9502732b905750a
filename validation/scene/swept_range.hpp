// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a swept quantity: from, to, and a step or a count.
#pragma once

#include <optional>
#include <string>

#include "validation/scene/option_values.hpp"

namespace clatter::validation::inline scene {

/// From, to and step or count of a swept quantity.
struct SweepTexts {
  std::optional<std::string> from, to, step, count;
};

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
[[nodiscard]] Sweep read_sweep(const SweepTexts& texts, const SweepDefault& fallback, const Range& range);

}  // namespace clatter::validation::inline scene
