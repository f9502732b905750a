// SPDX-License-Identifier: GPL-3.0-or-later
// The time history of a run as a CSV file.
#pragma once

#include <string>
#include <vector>

#include "numeric/drop/history.hpp"
#include "validation/output/report.hpp"
#include "validation/output/sink.hpp"
#include "validation/run/time_window.hpp"

namespace clatter::validation {

/// A sample's numbers: t, x, …, in_contact.
[[nodiscard]] std::vector<Column> history_columns();
/// Names of a sample's numbers: t, x, …, in_contact (0 or 1).
[[nodiscard]] const std::vector<std::string>& history_names();
/// The numbers in that order; SI, world frame.
[[nodiscard]] std::vector<double> history_numbers(const numeric::HistorySample& sample);

/// Streams samples into a file that appears whole or not at all.
class HistoryFile : public numeric::HistoryRecorder {
 public:
  /// @param head  lines without "# ", written first.  @param window  what of the history is written.
  /// @throws BadInput if the file cannot be created.
  HistoryFile(const std::string& path, const std::vector<std::string>& head, const TimeWindow& window = {});
  void record(const numeric::HistorySample& sample) override;
  void commit() { sink_.commit(); }

 private:
  Sink sink_;
  TimeWindow window_;
};

/// Samples of the fall from rest that ends in `touch` at time 0: `parts` of them, from the release on.
void record_fall(numeric::HistoryRecorder& recorder, const numeric::MotionState& touch, double mass, double gravity,
                 int parts);

}  // namespace clatter::validation
