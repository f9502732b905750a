// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/flights.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::validation::inline measured {
namespace {

constexpr double explained = 5;  // standard deviations
constexpr std::size_t seed_frames = 4;
constexpr std::size_t window = 12;  // frames that a new one is fitted with
constexpr std::size_t rest_frames = 5;
constexpr std::size_t gravity_frames = 8, noise_frames = 16;
constexpr std::size_t gravity_flights = 5;
constexpr std::size_t most_torn = 2;  // in a row
constexpr double unknown_gravity = 0.05, least_spread = 1e-3;

/// Grows flights through the frames of a track up to `end`.
class FlightSearch {
 public:
  FlightSearch(const Track& track, const FlightModel& model, std::size_t end)
      : track_(track), model_(model), end_(end) {}

  TrackFlights run() {
    std::size_t start = 0;
    while (start + seed_frames <= end_) {
      FlightFrames flight;
      for (std::size_t i = 0; i < seed_frames; ++i) flight.push_back(start + i);
      if (!explains(flight)) {
        result_.contact.push_back(start++);
        continue;
      }
      grow(flight);
      start = flight.back() + 1;
      result_.flights.push_back(std::move(flight));
    }
    for (; start < end_; ++start) result_.contact.push_back(start);
    return std::move(result_);
  }

 private:
  void grow(FlightFrames& flight) {
    for (std::size_t next = flight.back() + 1; next < end_;) {
      const std::size_t step = step_to(flight, next);
      if (step == 0) return;
      for (std::size_t torn = next; torn < next + step - 1; ++torn) result_.torn.push_back(torn);
      flight.push_back(next + step - 1);
      next += step;
    }
  }

  /// 1 if the next frame belongs; more if that many but one are torn; 0 if the flight has ended.
  std::size_t step_to(const FlightFrames& flight, std::size_t next) {
    if (explains_with(flight, {next})) return 1;
    for (std::size_t torn = 1; torn <= most_torn; ++torn) {
      const std::size_t after = next + torn;
      if (after + 1 < end_ && explains_with(flight, {after, after + 1})) return torn + 1;
    }
    return 0;
  }

  bool explains_with(const FlightFrames& flight, std::initializer_list<std::size_t> more) {
    FlightFrames last(flight.end() - static_cast<std::ptrdiff_t>(std::min(flight.size(), window)), flight.end());
    last.insert(last.end(), more);
    return explains(last);
  }

  bool explains(const FlightFrames& indices) {
    frames_.clear();
    for (const std::size_t i : indices) frames_.push_back(track_.frames[i]);
    const FlightFit fit(frames_, model_);
    return std::all_of(frames_.begin(), frames_.end(),
                       [&](const Frame& frame) { return fit.residual(frame) <= explained; });
  }

  const Track& track_;
  const FlightModel& model_;
  std::size_t end_;
  std::vector<Frame> frames_;
  TrackFlights result_;
};

}  // namespace

std::size_t resting_frames(const Track& track, const PoseNoise& noise) {
  const std::vector<Frame>& f = track.frames;
  if (f.empty()) return 0;
  std::size_t count = 0;
  for (; count < f.size(); ++count) {
    const Frame &frame = f[f.size() - 1 - count], &last = f.back();
    const double moved = (frame.position - last.position).cwiseAbs().maxCoeff() / noise.position;
    const double turned =
        rotation_vector(frame.attitude * last.attitude.conjugate()).cwiseAbs().maxCoeff() / noise.rotation;
    if (!(std::max(moved, turned) <= std::sqrt(2.0) * explained)) break;
  }
  return count >= rest_frames ? count : 0;
}

TrackFlights find_flights(const Track& track, const FlightModel& model) {
  const std::size_t rest = resting_frames(track, model.noise);
  TrackFlights flights = FlightSearch(track, model, track.frames.size() - rest).run();
  flights.rests = rest > 0;
  return flights;
}

FlightFit fit_flight(const Track& track, const FlightFrames& frames, const FlightModel& model, FlightSide side,
                     std::size_t most) {
  const std::size_t count = std::min(most, frames.size()), skip = side == FlightSide::last ? frames.size() - count : 0;
  std::vector<Frame> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(track.frames[frames[skip + i]]);
  return {chosen, model};
}

PoseNoise flight_noise(const TrackFile& file, const std::vector<TrackFlights>& flights, const FlightModel& model) {
  std::vector<double> parts[6];
  for (std::size_t i = 0; i < file.tracks.size(); ++i) {
    for (const FlightFrames& flight : flights[i].flights) {
      const std::size_t count = std::min(flight.size(), noise_frames);
      if (count < gravity_frames) continue;
      const FlightFit fit = fit_flight(file.tracks[i], flight, model, FlightSide::last, count);
      const double taken = std::sqrt(1 - 2.0 / static_cast<double>(count));  // by two parameters an axis
      for (std::size_t k = flight.size() - count; k < flight.size(); ++k) {
        const auto off = fit.standard_residual(file.tracks[i].frames[flight[k]]);
        for (int part = 0; part < 6; ++part) parts[part].push_back(std::fabs(off[part]) / taken);
      }
    }
  }
  if (parts[0].empty()) return model.noise;
  PoseNoise noise;
  for (int part = 0; part < 6; ++part) {
    const double deviation = deviation_of_median * median(parts[part]);
    double& size = part < 3 ? noise.position : noise.rotation;
    size = std::max(size, deviation * (part < 3 ? model.noise.position : model.noise.rotation));
  }
  return noise;
}

FallGravity fall_gravity(const TrackFile& file, const PoseNoise& noise) {
  const double stated = file.description.gravity;
  const FallGravity known{stated, unknown_gravity * stated};
  const FlightModel wide{noise, {stated, stated}, file.description.is_planar()};
  std::vector<double> falls, own;
  for (const Track& track : file.tracks) {
    const TrackFlights found = find_flights(track, {noise, {stated, 2 * known.spread}, wide.planar});
    if (found.flights.empty() || found.flights[0].size() < gravity_frames) continue;
    const FlightFit fall = fit_flight(track, found.flights[0], wide, FlightSide::first, track.frames.size());
    falls.push_back(fall.gravity());
    own.push_back(fall.gravity_error());
  }
  if (falls.size() < gravity_flights) return known;
  const double middle = median(falls);
  for (double& fall : falls) fall = std::fabs(fall - middle);
  const double spread = deviation_of_median * median(falls), known_to = median(own);
  const double rest =
      std::max(0.0, spread * spread - known_to * known_to) + spread * spread / static_cast<double>(falls.size());
  return {middle, std::max(least_spread, std::sqrt(rest))};
}

}  // namespace clatter::validation::inline measured
