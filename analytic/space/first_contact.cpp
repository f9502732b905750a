// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/first_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analytic/detail/limits.hpp"
#include "analytic/errors.hpp"
#include "analytic/space/point_search.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::never_happens;

namespace {

/// Length of a piece [rad].
constexpr double piece_angle = 0.6;
constexpr int most_pieces = 1 << 18;
/// Stretches of fewer pieces are looked through at once.
constexpr double shortest_stretch = 24;

class Search {
 public:
  Search(const Body& body, const FreeFlight& flight, std::span<const Touch> touching)
      : flight_(flight), touching_(touching), search_(body, flight), heights_(search_.heights()),
        found_(search_.found()) {}

  FirstContact run() {
    const FlightMoment start = heights_.moment(0);
    if (!depart(start)) return std::move(found_);
    march(start);
    if (found_.end == FlightEnd::contact) arrive();
    return std::move(found_);
  }

 private:
  [[nodiscard]] const Touch* touch(int point) const {
    const auto at = std::find_if(touching_.begin(), touching_.end(), [&](const Touch& t) { return t.point == point; });
    return at == touching_.end() ? nullptr : &*at;
  }

  /// Sets the points' heights at t = 0; false if the flight ends there.
  bool depart(const FlightMoment& start) {
    const auto count = static_cast<std::size_t>(heights_.count());
    from_.resize(count);
    to_.resize(count);
    depths_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const int point = static_cast<int>(i);
      PointHeight& h = from_[i] = heights_.at(point, start);
      // With room for rounding, and for the point to be well above the ground where the search begins again.
      depths_[i] = heights_.depth(point) + heights_.reach() / 1024;
      const Touch* known = touch(point);
      if (known) h.velocity = known->normal_velocity;
      if (known || std::fabs(h.height) <= heights_.noise(0)) h.height = 0;
      if (h.height == 0 && h.velocity < 0 && !(found_.end == FlightEnd::contact)) search_.take(point, 0, {0, 0});
      if (!known || h.velocity != 0 || found_.end == FlightEnd::contact) continue;
      if (h.acceleration < 0) {
        found_.end = FlightEnd::stays_touching;
        found_.acceleration = h.acceleration;
        found_.point = point;
      }
    }
    if (found_.end == FlightEnd::contact) arrive();
    return found_.end == FlightEnd::no_contact;
  }

  void march(FlightMoment start) {
    const double deepest = *std::max_element(depths_.begin(), depths_.end());
    const double rises = flight_.rises_through(deepest), falls = flight_.falls_through(deepest);
    const double certain = flight_.falls_through(-heights_.reach());
    const bool ever_falls = falls < never_happens;
    if (!through(start, std::fmin(rises, certain))) return;
    if (!ever_falls || !(falls > start.time)) return;
    if (falls * epsilon * flight_.rotation().fastest() > 1e-3 || !(falls < falls * (1 + 4 * epsilon))) {
      throw NumericalError("the flight is so long that double precision leaves the phase at its end no digit");
    }
    start = heights_.moment(falls);
    ++found_.evaluations;
    through(start, certain);
  }

  /// Looks through pieces from `start` to `end`; false when the first contact was found.  Leaves `start` at the end.
  bool through(FlightMoment& start, double end) {
    const double speed = flight_.rotation().fastest();
    const bool periodic_hover = end == never_happens && flight_.gravity() == 0 && !(flight_.start().velocity.z() < 0);
    if (speed == 0) {
      if (end < never_happens) return pieces(start, end, end);
      return true;  // a body that neither turns nor falls
    }
    if (periodic_hover && flight_.rotation().is_steady()) end = start.time + 2 * std::numbers::pi / speed;
    return stretch(start, end, piece_angle / speed);
  }

  /// Leaves out what is clear whatever the spin, so that many turns far above the ground cost little.
  bool stretch(FlightMoment& start, double end, double length) {
    if (!(end - start.time > shortest_stretch * length) || end == never_happens) return pieces(start, end, length);
    const FlightMoment last = heights_.moment(end);
    ++found_.evaluations;
    const double lowest = heights_.lowest_between(start, last);
    if (lowest > 0) {
      NearMiss& miss = found_.near_miss;
      if (lowest < std::fmin(search_.threshold(), miss.clearance)) {
        miss = {.clearance = lowest, .margin = heights_.noise(end), .time = start.time, .vertex = 0};
      }
      start = last;
      return true;
    }
    const double middle = start.time + (end - start.time) / 2;
    return stretch(start, middle, length) && stretch(start, end, length);
  }

  bool pieces(FlightMoment& start, double end, double length) {
    if (from_.front().time != start.time) {
      for (std::size_t i = 0; i < from_.size(); ++i) from_[i] = heights_.at(static_cast<int>(i), start);
    }
    while (start.time < end) {
      if (++pieces_ > most_pieces) throw NumericalError("no contact found nor excluded in 250 000 pieces of a flight");
      const double stop = start.time + length < end ? start.time + length : end;
      if (!(stop > start.time)) throw NumericalError("the flight is so long that no double tells its pieces apart");
      const FlightMoment next = heights_.moment(stop);
      ++found_.evaluations;
      // While the centre of mass is above a point's depth, the point is above the ground; a parabola is lowest at an
      // end.
      const double lowest = std::fmin(start.centre, next.centre);
      for (std::size_t i = 0; i < from_.size(); ++i) {
        to_[i] = heights_.at(static_cast<int>(i), next);
        if (lowest <= depths_[i]) search_.look(static_cast<int>(i), {start, from_[i]}, {next, to_[i]});
      }
      if (found_.end == FlightEnd::contact) return false;
      start = next;
      from_.swap(to_);
    }
    return true;
  }

  /// The point's velocity, and those that arrive with it.
  void arrive() {
    const double best = search_.best();
    const FlightMoment moment = heights_.moment(best);
    ++found_.evaluations;
    const State& start = flight_.start();
    const double parts =
        std::fabs(start.velocity.z()) + flight_.gravity() * best + flight_.rotation().fastest() * heights_.reach();
    found_.velocity_error = 4 * epsilon * parts;
    const PointHeight first =
        best == 0 ? from_[static_cast<std::size_t>(found_.point)] : heights_.at(found_.point, moment);
    found_.normal_velocity = search_.arrival_velocity(first, found_.velocity_error);
    found_.acceleration = first.acceleration;
    found_.together.assign(1, found_.point);
    for (int i = 0; i < heights_.count(); ++i) {
      if (i == found_.point) continue;
      const PointHeight h = best == 0 ? from_[static_cast<std::size_t>(i)] : heights_.at(i, moment);
      // The others' heights err by the time's error, too.
      const double slower = std::fabs(h.velocity / first.velocity);
      if (std::fabs(h.height) <= heights_.noise(best) * (1 + slower) && h.velocity < 0) found_.together.push_back(i);
    }
  }

  const FreeFlight& flight_;
  std::span<const Touch> touching_;
  PointSearch search_;
  PointHeights& heights_;
  FirstContact& found_;
  std::vector<PointHeight> from_, to_;
  std::vector<double> depths_;
  int pieces_ = 0;
};

}  // namespace

FirstContact first_contact(const Body& body, const FreeFlight& flight, std::span<const Touch> touching) {
  return Search(body, flight, touching).run();
}

}  // namespace clatter::analytic::space
