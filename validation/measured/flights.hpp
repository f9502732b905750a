// SPDX-License-Identifier: GPL-3.0-or-later
// A track taken apart: the flights between its impacts, and the frames that belong to none.
#pragma once

#include <vector>

#include "validation/measured/flight_fit.hpp"

namespace clatter::validation::inline measured {

/// Indices of a track's frames that one flight explains, in order.
using FlightFrames = std::vector<std::size_t>;

struct TrackFlights {
  std::vector<FlightFrames> flights;
  std::vector<std::size_t> torn;     ///< frames inside a flight that lie off it: outliers of the tracking
  std::vector<std::size_t> contact;  ///< frames between two flights: in contact, or in a flight of fewer than 4 frames
  bool rests = false;                ///< the last frames do not move
};

/// Flights are grown from four frames that one motion explains within 5 standard deviations, a frame at a time: a
/// frame belongs if the fit with it and its neighbours before still explains all of them.  One or two frames that lie
/// off while the next two go on are torn.  From where the body rests nothing is a flight.
[[nodiscard]] TrackFlights find_flights(const Track& track, const FlightModel& model);

/// Frames at the end during which the body does not move: their position and attitude stay within 5 standard
/// deviations; 0 if fewer than 5.
[[nodiscard]] std::size_t resting_frames(const Track& track, const PoseNoise& noise);

/// The flight of these frames, of the first or the last `most` of them.
enum class FlightSide { first, last };
[[nodiscard]] FlightFit fit_flight(const Track& track, const FlightFrames& frames, const FlightModel& model,
                                   FlightSide side, std::size_t most);

/// Noise from what flights of 8 frames or more leave unexplained, of the noisiest axis; the model's own without any.
/// Better than pose_noise(), which impacts and torn frames enlarge.
[[nodiscard]] PoseNoise flight_noise(const TrackFile& file, const std::vector<TrackFlights>& flights,
                                     const FlightModel& model);

/// Gravity along the falls: the middle of all first flights of 8 frames or more, and its spread beyond their own
/// errors; where there are fewer than 5 of those the description's, known to 5 %.
[[nodiscard]] FallGravity fall_gravity(const TrackFile& file, const PoseNoise& noise);

}  // namespace clatter::validation::inline measured
