// SPDX-License-Identifier: GPL-3.0-or-later
// Where the motion of a track changes: impacts, and what else happens between two flights.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analytic/base/angle.hpp"
#include "validation/measured/flights.hpp"

namespace clatter::validation {

/// Why the motion changed between two flights.
enum class Change {
  impact,    ///< the lowest point is at the ground
  skipped,   ///< the same flight goes on, later by some frames that the file's samples do not count
  disturbed  ///< neither: a wall, or torn frames
};

/// Two flights between which the motion changed.
struct Meeting {
  Change change = Change::impact;
  int number = 0;  ///< of the impact in its track, from 1; of other changes that of the impact before
  FlightFit before, after;
  int between = 0;       ///< frames between the two flights: in contact, or torn
  double time = 0;       ///< at which the two motions are nearest to each other [s]
  double distance = 0;   ///< between their poses then, in standard deviations of a pose
  double low = 0;        ///< height of the lowest point then, of the body as described [m]
  double low_error = 0;  ///< standard deviation of that by the poses' noise [m]
  double skipped = 0;    ///< of Change::skipped: the time that the samples leave out [s]
};

/// Everything read from one track.
struct MeasuredTrack {
  std::string name{};
  TrackFlights flights{};
  int missing = 0;
  std::vector<Meeting> meetings{};       ///< impacts
  std::vector<Meeting> other_changes{};  ///< of the motion, away from the ground
  std::optional<Quaternion> rest{};      ///< attitude at rest, as tracked
};

/// A file taken apart, with what its frames say of themselves.
struct MeasuredFile {
  TrackFile file;
  FlightModel model;
  std::vector<MeasuredTrack> tracks;
};
[[nodiscard]] MeasuredFile measure_tracks(TrackFile file);

// The impacts of a track: when, where, and the motion before and after, with errors.

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
  double angle = 0;               ///< between the arm and the downward vertical [rad]

  [[nodiscard]] double angle_degrees() const { return angle * analytic::degrees_per_radian; }
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

}  // namespace clatter::validation
