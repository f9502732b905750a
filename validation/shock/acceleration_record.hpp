// SPDX-License-Identifier: GPL-3.0-or-later
// Accelerations over time that a logger or a drop tower wrote.
//
// A file is a text with a row of numbers for each instant, read by TextRows; a sampling rate is taken from the lines
// above the rows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/shock/point_motion.hpp"

namespace clatter::validation {

enum class AccelerationUnit { g, metre_per_second_squared };

/// What a record is, where its file does not say so.
struct RecordRequest {
  std::string path;
  std::vector<std::string> columns{};      ///< of acceleration, one to three; empty: those that look like it
  std::optional<double> rate{};            ///< in place of a column of time [Hz]
  std::optional<AccelerationUnit> unit{};  ///< in place of what the file says
};

struct AccelerationRecord {
  std::string path;
  std::vector<std::string> axes;     ///< names of the columns, one to three
  std::vector<double> times;         ///< rising [s]
  std::vector<Vector3> values;       ///< along those axes, 0 along what is missing [m/s²]
  std::vector<std::string> remarks;  ///< what was taken for what

  /// The median distance of samples [s].
  [[nodiscard]] double step() const;
};

/// @throws BadInput "FILE:LINE:COLUMN: …" or "FILE: …": a file that cannot be read or has less than eight rows, rows of
///         different lengths, a field that is no finite number, time that does not rise, columns or a unit or a rate
///         that the file leaves open.
[[nodiscard]] AccelerationRecord read_accelerations(const RecordRequest& request);

}  // namespace clatter::validation
