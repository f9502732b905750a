// SPDX-License-Identifier: GPL-3.0-or-later
// The time history of a run as a CSV file.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "numeric/drop/history.hpp"
#include "validation/output/report.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation {

// The times that pictures and histories show.

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

/// A sample's numbers: t, x, …, in_contact.
[[nodiscard]] std::vector<Column> history_columns();
/// Names of a sample's numbers: t, x, …, in_contact (0 or 1).
[[nodiscard]] const std::vector<std::string>& history_names();
/// The numbers in that order; SI, world frame.
[[nodiscard]] std::vector<double> history_numbers(const numeric::HistorySample& sample);

/// Streams samples into a file that appears whole or not at all.
class HistoryFile {
 public:
  /// @param head  lines without "# ", written first.  @param window  what of the history is written.
  /// @throws BadInput if the file cannot be created.
  HistoryFile(const std::string& path, const std::vector<std::string>& head, const TimeWindow& window = {});
  void write(const numeric::HistorySample& sample);
  void commit() { sink_.commit(); }

 private:
  Sink sink_;
  TimeWindow window_;
};

/// Samples of the free flight that ends in `touch` at time 0: `parts` of them, over `fall` [s]; none if that is 0.
void record_fall(const numeric::HistoryRecorder& recorder, const numeric::Body& body, const numeric::World& world,
                 const numeric::MotionState& touch, double fall, int parts);

}  // namespace clatter::validation
