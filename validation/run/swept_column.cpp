// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/swept_column.hpp"

#include <fmt/format.h>

namespace clatter::validation {

Column swept_column(const SceneSweep& sweep) {
  const bool over_angle = sweep.quantity == SceneSweep::Quantity::angle_deg;
  return {.name = sweep.name(),
          .heading = over_angle ? "angle" : "μₖ",
          .unit = over_angle ? "°" : "",
          .meaning = "swept: " + swept_words(sweep)};
}

std::string swept_words(const SceneSweep& sweep) {
  return sweep.quantity == SceneSweep::Quantity::angle_deg ? "contact angle θ" : "friction coefficient μ";
}

Range2 swept_range(double first, double last) {
  return first < last ? Range2{first, last} : Range2{first - 0.5, last + 0.5};
}

void add_interruption(const SceneSweep& sweep, std::size_t done, Report& report) {
  const std::size_t values = sweep.values().size();
  if (done < values) report.notes.push_back(fmt::format("interrupted: {} of {} values", done, values));
}

}  // namespace clatter::validation
