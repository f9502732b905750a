// SPDX-License-Identifier: GPL-3.0-or-later
// Where the motion of a track changes: impacts, and what else happens between two flights.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/measured/flights.hpp"

namespace clatter::validation::inline measured {

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

/// The changes of motion in a track.  Flights between which no component of velocity or angular velocity changes by
/// more than 6 standard deviations are one; so are, away from the ground, those whose motion changes by less than a
/// twentieth: walls slow a fall and its turning.
[[nodiscard]] std::vector<Meeting> find_meetings(const Track& track, const TrackFlights& flights,
                                                 const FlightModel& model, const TrackedBody& body);

/// Everything read from one track.
struct MeasuredTrack {
  std::string name;
  TrackFlights flights;
  int missing = 0;
  std::vector<Meeting> meetings;       ///< impacts
  std::vector<Meeting> other_changes;  ///< of the motion, away from the ground
  std::optional<Quaternion> rest;      ///< attitude at rest, as tracked
  std::optional<Vector3> rest_position;
};

/// A file taken apart, with what its frames say of themselves.
struct MeasuredFile {
  TrackFile file;
  FlightModel model;
  std::vector<MeasuredTrack> tracks;
};
[[nodiscard]] MeasuredFile measure_tracks(TrackFile file);

}  // namespace clatter::validation::inline measured
