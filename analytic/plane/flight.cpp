// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/flight.hpp"

#include <cmath>

#include "analytic/base/angle.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/plane/first_root.hpp"

namespace clatter::analytic {

using detail::epsilon;
using detail::never;

namespace {

bool contains(VertexSet set, int vertex) { return (set >> vertex & 1) != 0; }

/// Height of a vertex at the end of the flight, as a function of the inclination then.  Equal to
/// flight.hpp (1), but written so that small inclinations keep their relative accuracy:
///     h = α₀ A + α (x_j − x_i − A) + x_i d(α₀) − x_j d(α) + (z_j − z_i)
///         + z_i vers α₀ − z_j vers α − g t²/2,   d(x) = x − sin x,
///     A = V/Ω − x_i = w/Ω − x_i vers α₀ − z_i sin α₀
/// with i the vertex that struck last, w its rebound speed and t = (α₀ − α)/Ω.
struct FinalHeight {
  double alpha0, rebound_term, slope, constant, gravity, angular;
  Vertex target;

  FinalHeight(const PlanarBody& body, const Departure& d, int vertex)
      : alpha0(d.inclination), gravity(d.gravity), angular(d.angular), target(body.vertices[vertex]) {
    const auto [x, z] = body.vertices[d.reference];
    const double vers = detail::versine(alpha0);
    rebound_term = d.rebound_speed / angular - x * vers - z * d.sine;
    slope = target.x - x - rebound_term;
    constant = alpha0 * rebound_term + x * detail::sine_deficit(alpha0) + (target.z - z) + z * vers;
  }

  /// One Newton step from `alpha`, refused where the graze makes it larger than rounding can be.
  [[nodiscard]] double polish(double alpha) const {
    const double t = (alpha0 - alpha) / angular;
    const double vers = detail::versine(alpha);
    const double height = std::fma(alpha, slope, constant) - target.x * detail::sine_deficit(alpha) - target.z * vers -
                          gravity / 2 * t * t;
    const double derivative = slope - target.x * vers - target.z * std::sin(alpha) + gravity * t / angular;
    const double step = height / derivative;
    return std::fabs(step) <= 1e-8 * std::fabs(alpha0 - alpha) ? alpha - step : alpha;
  }
};

/// Fills in the inclination, with the time to match, from the root's time.
void finish(const PlanarBody& body, const Departure& departure, Flight& flight) {
  Arrival& arrival = flight.arrival;
  arrival.inclination = departure.inclination - departure.angular * arrival.time;
  const double turned = std::fabs(departure.angular * arrival.time);
  if (departure.angular == 0 || arrival.within_margin || !(std::fabs(arrival.inclination) < turned)) {
    return;
  }
  const FinalHeight height(body, departure, arrival.vertex);
  arrival.inclination = height.polish(arrival.inclination);
  arrival.time = (departure.inclination - arrival.inclination) / departure.angular;
  ++flight.evaluations;
}

/// Vertices whose height at the arrival is zero to rounding arrive together.
/// @param turn  until the arrival
VertexSet together(const std::array<VertexHeight, max_vertices>& heights, int count, const Arrival& arrival,
                   const detail::Turn& turn) {
  VertexSet set = static_cast<VertexSet>(1u << arrival.vertex);
  for (int i = 0; i < count; ++i) {
    if (i == arrival.vertex) continue;
    const auto [height, velocity, scale] = heights[i].at(arrival.time, turn);
    if (std::fabs(height) <= 4 * epsilon * scale && velocity < 0) {
      set |= static_cast<VertexSet>(1u << i);
    }
  }
  return set;
}

/// A touching vertex that already approaches again arrives at once.
bool arrives_at_once(const VertexHeight& height) { return height.height == 0 && height.velocity < 0; }

bool cannot_leave(const VertexHeight& height) {
  return height.height == 0 && height.velocity == 0 && !(height.acceleration(0) > 0);
}

class Race {
 public:
  Race(const PlanarBody& body, const Departure& departure, Passes* passes) : departure_(departure), passes_(passes) {
    if (passes_) passes_->fill({.clearance = never});
    for (int i = 0; i < body.vertex_count; ++i) heights_[i] = vertex_height(body, departure, i);
  }

  /// Vertex by vertex, each only up to the earliest arrival so far; those that touch go last, since
  /// they usually rise.
  Flight run(const PlanarBody& body) {
    best_ = never;
    flight_.near_miss.clearance = never;
    for (int i = 0; i < body.vertex_count; ++i) {
      if (arrives_at_once(heights_[i])) take_at_once(i);
    }
    if (flight_.end != FlightEnd::contact && some_stays(body)) return flight_;
    for (const bool touching : {false, true}) {
      for (int i = 0; i < body.vertex_count; ++i) {
        if (contains(departure_.touching, i) == touching) enter(i);
      }
    }
    if (flight_.end == FlightEnd::contact) {
      flight_.arrival.vertices = together(heights_, body.vertex_count, flight_.arrival, turn_);
      if (flight_.arrival.time > 0) finish(body, departure_, flight_);
      else flight_.arrival.inclination = departure_.inclination;
    }
    return flight_;
  }

 private:
  /// Whether a vertex stays on the ground, which ends the flight.
  bool some_stays(const PlanarBody& body) {
    for (int i = 0; i < body.vertex_count && departure_.gravity > 0; ++i) {
      if (!cannot_leave(heights_[i])) continue;
      flight_.end = FlightEnd::stays_touching;
      flight_.arrival.vertex = i;
      return true;
    }
    return false;
  }

  void take_at_once(int vertex) {
    FirstRoot now;
    now.time = 0;
    take(vertex, now);
  }

  void enter(int vertex) {
    const VertexHeight& height = heights_[vertex];
    if (arrives_at_once(height)) return;
    if (best_ < never && stays_above(height, best_, turn_)) {
      ++flight_.evaluations;
      return;
    }
    const FirstRoot root = first_root(height, best_);
    flight_.evaluations += root.evaluations;
    if (passes_) (*passes_)[static_cast<std::size_t>(vertex)] = root.near_miss;
    if (root.near_miss.clearance < flight_.near_miss.clearance) {
      flight_.near_miss = root.near_miss;
      flight_.near_miss.vertex = vertex;
    }
    if (root.time && *root.time < best_) take(vertex, root);
  }

  void take(int vertex, const FirstRoot& root) {
    best_ = *root.time;
    turn_ = detail::Turn(heights_[vertex].rate * best_);
    flight_.end = FlightEnd::contact;
    flight_.arrival.time = best_;
    flight_.arrival.vertex = vertex;
    flight_.arrival.bracket_low = root.bracket_low;
    flight_.arrival.bracket_high = root.bracket_high;
    flight_.arrival.within_margin = root.within_margin;
  }

  const Departure& departure_;
  Passes* passes_;
  std::array<VertexHeight, max_vertices> heights_{};
  Flight flight_;
  double best_ = never;   ///< time of the earliest arrival so far
  detail::Turn turn_{0};  ///< until then
};

}  // namespace

ContactPoint Departure::offset(const PlanarBody& body, int from, int to) const {
  const double x = body.vertices[to].x - body.vertices[from].x;
  const double z = body.vertices[to].z - body.vertices[from].z;
  return {.tangential = x * cosine - z * sine, .normal = x * sine + z * cosine};
}

VertexHeight vertex_height(const PlanarBody& body, const Departure& departure, int vertex) {
  const ContactPoint d = body.contact_point(vertex, departure.sine, departure.cosine);
  const ContactPoint offset = departure.offset(body, departure.reference, vertex);
  const bool touching = contains(departure.touching, vertex);
  const double sense = departure.angular < 0 ? -1 : 1;
  return {.height = touching ? 0 : offset.normal,
          .velocity = departure.rebound_speed - departure.angular * offset.tangential,
          .gravity = departure.gravity,
          .rate = std::fabs(departure.angular),
          .versine = -d.normal,
          .sine = sense * d.tangential};
}

Flight fly(const PlanarBody& body, const Departure& departure, Passes* passes) {
  return Race(body, departure, passes).run(body);
}

}  // namespace clatter::analytic
