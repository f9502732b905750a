// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/sequence_options.hpp"

#include <algorithm>
#include <cmath>

#include "analytic/base/errors.hpp"

namespace clatter::analytic {

void SequenceOptions::validate() const {
  detail::require(impacts >= 1, "impacts", impacts, "at least 1");
  detail::require(!std::isnan(until), "until", until, "a number");
  const bool is_ascending = std::is_sorted(times.begin(), times.end()) &&
                            std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); });
  detail::require(is_ascending, "number of times", static_cast<double>(times.size()),
                  "of finite ones in ascending order");
  detail::require(digits >= 1 && digits <= 15, "digits", digits, "between 1 and 15");
}

}  // namespace clatter::analytic
