// SPDX-License-Identifier: GPL-3.0-or-later
// The blows in a record of accelerations, and their response spectra: `clatter shock --measured`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/output/text_rows.hpp"
#include "validation/shock/point_motion.hpp"
#include "validation/shock/shock_report.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation {

// Accelerations over time that a logger or a drop tower wrote.
//
// A file is a text with a row of numbers for each instant, read by TextRows; a sampling rate is taken from the lines
// above the rows.

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

/// One blow of a record, along its axes.  Errors are not finite where the samples do not tell.
struct MeasuredBlow {
  std::size_t first = 0, last = 0;  ///< samples over which ΔV is the integral
  std::size_t largest = 0;          ///< the sample of the peak
  double time = 0;                  ///< in the record, when the size first exceeds a tenth of the peak [s]
  double peak_time = 0;             ///< after that [s]
  double width = 0;                 ///< until it last exceeds a tenth of the peak [s]
  Vector3 delta_v = Vector3::Zero();
  Estimated delta_v_size;  ///< |∫a dt| [m/s]
  Vector3 peak = Vector3::Zero();
  Estimated peak_size;  ///< of the largest sample [m/s²]
  double width_error = 0;
};

struct MeasuredShock {
  AccelerationRecord record;
  std::vector<MeasuredBlow> blows;
  std::vector<Spectrum> spectra;  ///< from the beginning until the second blow, the one after the first ones, the end
  Vector3 before = Vector3::Zero();   ///< mean reading just before the first blow [m/s²]
  Vector3 after = Vector3::Zero();    ///< and just after the last
  double noise = 0;                   ///< standard deviation of a reading between the blows, by neighbours [m/s²]
  std::vector<std::string> findings;  ///< clipping, drift, gaps, blows of too few samples
};

/// A blow is where the size of the acceleration exceeds a tenth of the record's largest, and 1.5 g; parts nearer to one
/// another than half the longer one's width are one blow.  ΔV is the integral of the reading, by trapezia, out to where
/// the size no longer falls. Errors: of ΔV those of the trapezia by second differences, noise, the zero before the
/// first blow and the pull of gravity, over the blow; of the peak a curve's sag between samples, by second differences,
/// and noise.  A blow that is clipped or narrower than five samples has no known peak.
/// @throws BadInput if no blow stands out.
[[nodiscard]] MeasuredShock measure_shock(AccelerationRecord record, const ShockRequest& request);

[[nodiscard]] std::vector<Column> measured_shock_columns();
/// @param simulated  the drop beside it, of one probe; null: none
[[nodiscard]] Report measured_shock_report(const MeasuredShock& shock, const ShockRequest& request,
                                           const ShockView& view, const ShockRun* simulated);
/// The record, its spectra and the damage boundary.
[[nodiscard]] Picture measured_shock_picture(const MeasuredShock& shock, const ShockRequest& request,
                                             const ShockView& view, const ShockRun* simulated);

}  // namespace clatter::validation
