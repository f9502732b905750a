// SPDX-License-Identifier: GPL-3.0-or-later
// The times that pictures and histories show.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace clatter::validation {

/// From one time to another after the first touch-down, both taken [s].
struct TimeWindow {
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool holds(double time) const { return time >= from && time <= to; }
  [[nodiscard]] std::string text() const;  ///< "FROM:TO"
  [[nodiscard]] bool is_all() const { return from == -std::numeric_limits<double>::infinity(); }
};

/// "FROM:TO", given under a name.  @throws BadInput unless both are finite numbers and FROM < TO.
[[nodiscard]] TimeWindow read_window(const std::string& name, const std::string& text);

/// The rows in the window of some that begin with a time, in order; where others lie beyond an end of the window, a row
/// there on the straight line between its neighbours, so that curves reach the frame.
[[nodiscard]] std::vector<std::vector<double>> clipped(const std::vector<std::vector<double>>& rows,
                                                       const TimeWindow& window);

}  // namespace clatter::validation
