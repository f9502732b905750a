// SPDX-License-Identifier: GPL-3.0-or-later
// The impacts of a track: when, where, and the motion before and after, with errors.
#pragma once

#include <optional>
#include <vector>

#include "validation/measured/meetings.hpp"

namespace clatter::validation::inline measured {

/// One impact as it was measured.
struct TrackImpact {
  int number = 1;
  double time = 0;                ///< at which the corner reaches the ground [s]
  double time_error = 0;          ///< standard deviation [s]
  MeasuredState before, after;    ///< at `time`, with the body's true axes
  double gravity = 0;             ///< of the flight after [m/s²]
  int between = 0;                ///< frames lost between the flights
  int corner = 0;                 ///< that is lowest at `time`
  Vector3 arm = Vector3::Zero();  ///< from the centre to the touching point, world frame [m]
  double height = 0;              ///< of the lowest point above the ground where the two motions meet [m]
  double lever_miss = 0;          ///< (1) of lever(): momentum about the corner that no impulse there explains
  double lever_error = 0;         ///< three standard deviations of that
  bool is_point = false;          ///< lever_miss is within the tolerance and its error
  int momentum_corner = 0;        ///< of those below the centre, the corner about which momentum is kept best
  double approach = 0;            ///< −normal velocity of the touching point before [m/s]
  double slip = 0;                ///< its tangential speed before [m/s]
  double restitution = 0;         ///< separation over approach
  double restitution_error = 0;   ///< standard deviation
  double impulse_ratio = 0;       ///< P_t/P_n
  double impulse_ratio_error = 0;
  bool slips_throughout = false;  ///< the slip keeps its direction within 60°: then impulse_ratio is μ
  double angle = 0;               ///< between the arm and the downward vertical [rad]

  [[nodiscard]] double angle_degrees() const { return angle * 57.29577951308232; }
};

/// Momentum about the touching point that an impulse there leaves unexplained, over |ΔV| times the corner's distance R:
///     lever = |r × ΔV − (I/m) ΔΩ|/(|ΔV| R).                                                       (1)
[[nodiscard]] double lever(const TrackedBody& body, const TrackImpact& impact, const Vector3& arm);

/// When the lowest corner of the flight reaches the ground; nothing if that is later than `until`.
[[nodiscard]] std::optional<double> contact_time(const TrackedBody& body, const FlightFit& flight, double start,
                                                 double until);

/// The impact of a meeting.
/// @param ground_error  standard deviation of the ground's height [m]
[[nodiscard]] TrackImpact measured_impact(const Meeting& meeting, const TrackedBody& body, double ground_error,
                                          double lever_tolerance);

}  // namespace clatter::validation::inline measured
