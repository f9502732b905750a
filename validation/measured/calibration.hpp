// SPDX-License-Identifier: GPL-3.0-or-later
// What a file says of its body before any impact law is asked: axes, ground, inertia, rounded corners.
#pragma once

#include <vector>

#include "validation/measured/meetings.hpp"
#include "validation/measured/robust_fit.hpp"

namespace clatter::validation {

/// Indices of tracks in a file: those to fit on, or those to score.
using TrackPart = std::vector<std::size_t>;

struct CalibrationResult {
  Calibration calibration;
  double ground_spread = 0;        ///< of the touches' heights, standard deviation [m]
  std::size_t resting = 0;         ///< tracks that end on a face, at rest
  std::size_t touches = 0;         ///< impacts that gave the ground's height
  double inertia_half_width = 0;   ///< of the 95 % interval
  double rounding_half_width = 0;  ///< likewise [m]
  double turn_error = 0;           ///< standard error [rad]
  double lever_before = 0;         ///< middle turning that point impacts leave unexplained, uniform and sharp
  double lever_after = 0;
};

/// The parts of a calibration that are fitted; the ground's height always is.
struct CalibrationParts {
  bool axes = true;     ///< of the body, from resting poses: a face lies flat
  bool inertia = true;  ///< and rounding, from the momentum about the touching point of first impacts
};

/// Calibrates on a part of a file.  Losses are capped, so that impacts on more than a point do not count.
[[nodiscard]] CalibrationResult calibrate(const MeasuredFile& file, const TrackPart& part,
                                          const CalibrationParts& parts);

/// Impact `number` of each track of a part that has one.
struct PartImpact {
  std::size_t track = 0;
  TrackImpact impact;
};
[[nodiscard]] std::vector<PartImpact> impacts_of(const MeasuredFile& file, const TrackPart& part,
                                                 const TrackedBody& body, double ground_error, int number);

}  // namespace clatter::validation
