// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/flight.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analytic/base/angle.hpp"
#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/base/root_finder.hpp"

namespace clatter::analytic {

VertexHeight::Value VertexHeight::at(double t, const detail::Turn& turn) const {
  const double linear = velocity * t;
  const double fall = gravity / 2 * t * t;
  const double versine_term = versine * turn.versine;
  const double sine_term = sine * turn.sine_deficit;
  return {.height = height + linear - fall + versine_term + sine_term,
          .velocity = velocity - gravity * t + rate * (versine * turn.sine + sine * turn.versine),
          .scale =
              std::fabs(height) + std::fabs(linear) + std::fabs(fall) + std::fabs(versine_term) + std::fabs(sine_term)};
}

double VertexHeight::acceleration(double t) const {
  const double turned = rate * t;
  return rate * rate * (versine * std::cos(turned) + sine * std::sin(turned)) - gravity;
}

double VertexHeight::velocity_scale(double t) const {
  const double turned = rate * t;
  const double reach = std::fabs(versine) + std::fabs(sine);
  const double of_turning =
      rate * (std::fabs(versine) * std::fmin(turned, 1) + std::fabs(sine) * std::fmin(turned * turned, 1));
  return std::fabs(velocity) + gravity * t + of_turning + (turned > 1 ? turned * rate * reach : 0);
}

using detail::epsilon;
using detail::never;

namespace {

/// Rounding error of a height at a turning point: this times the sum of the magnitudes of its
/// terms. Twice what is seen against 50 digits near the folds.
constexpr double height_noise = 2 * epsilon;

/// A moment of the flight.
struct Node {
  double t = 0;
  VertexHeight::Value value;
};

/// Search for the first root, piece by piece.
class Search {
 public:
  /// @param reach  √(p² + q²) of the height
  Search(const VertexHeight& height, double reach, FirstRoot& found) : h_(height), reach_(reach), found_(found) {
    phase_ = std::atan2(h_.sine, h_.versine);
    const double ratio = (h_.gravity / h_.rate) / (h_.rate * reach_);
    half_width_ = ratio >= 1 ? 0 : ratio <= -1 ? pi : std::acos(ratio);
  }

  /// Looks through [start, end]; true when the first root was found.
  bool window(double start, double end) {
    Node node = start > 0 ? at(start) : Node{0, {h_.height, h_.velocity, std::fabs(h_.height)}};
    if (start > 0 && !(node.value.height > 0)) return keep(start, {start, start});
    // Where in its period the curvature stands at the start.
    const double turned = h_.rate * start - phase_;
    const double place = std::fabs(turned) <= pi ? turned : std::remainder(turned, 2 * pi);
    bool convex = std::fabs(place) < half_width_ || half_width_ == pi;
    const double left = convex ? half_width_ - place : (place > 0 ? 2 * pi : 0) - half_width_ - place;
    double boundary = start + std::fmax(left, 0) / h_.rate;
    if (half_width_ == 0 || half_width_ == pi) boundary = never;
    while (node.t < end) {
      const double stop = std::min(boundary, end);
      const bool empty = !(stop > node.t);  // a piece no longer than rounding
      if (!empty && (convex ? convex_piece(node, stop) : concave_piece(node, stop))) return true;
      convex = !convex;
      boundary += 2 * (convex ? half_width_ : pi - half_width_) / h_.rate;
    }
    return false;
  }

 private:
  Node at(double t) {
    ++found_.evaluations;
    return {t, h_.at(t)};
  }

  bool keep(double root, detail::Bracket bracket) {
    found_.time = root;
    found_.bracket_low = bracket.low;
    found_.bracket_high = bracket.high;
    return true;
  }

  [[nodiscard]] static bool rises_from_ground(const Node& node) { return node.t == 0 && node.value.height == 0; }

  /// Root in (node, stop) of a piece that ends below the ground, from the cubic through the start's
  /// height, velocity and curvature and the end's height.
  bool crossing(const Node& node, const Node& last) {
    const detail::Bracket bracket{node.t, last.t};
    const bool rising = rises_from_ground(node);
    const double span = last.t - node.t;
    const double h0 = node.value.height, v0 = node.value.velocity;
    const double a0 = h_.acceleration(node.t) / 2;
    const double cubic = (last.value.height - h0 - span * (v0 + span * a0)) / (span * span * span);
    double x = rising && a0 < 0 ? std::min(-v0 / a0, span) : v0 < 0 ? std::min(-h0 / v0, span) : span / 2;
    for (int i = 0; i < 3; ++i) {
      const double value = rising ? v0 + x * (a0 + x * cubic) : h0 + x * (v0 + x * (a0 + x * cubic));
      const double slope = rising ? a0 + 2 * x * cubic : v0 + x * (2 * a0 + 3 * x * cubic);
      const double next = x - value / slope;
      if (!(next > 0 && next < span)) break;
      x = next;
    }
    return rising ? solve_quotient(bracket, x) : solve(bracket, node.t + x);
  }

  bool solve(detail::Bracket bracket, double guess) {
    const auto sample = [this](double t) -> detail::Sample {
      const auto [height, velocity, scale] = h_.at(t);
      return {height, velocity, epsilon / 2 * scale};
    };
    return polish(detail::FunctionView(sample), bracket, guess);
  }

  /// h(t)/t has the start's root at t = 0 divided out.
  bool solve_quotient(detail::Bracket bracket, double guess) {
    const auto sample = [this](double t) -> detail::Sample {
      const auto [height, velocity, scale] = h_.at(t);
      return {height / t, (velocity - height / t) / t, epsilon / 2 * scale / t};
    };
    return polish(detail::FunctionView(sample), bracket, guess);
  }

  bool polish(detail::FunctionView f, detail::Bracket bracket, double guess) {
    const detail::Root root = detail::bracketed_root(f, bracket, guess, false);
    found_.evaluations += root.evaluations;
    return keep(root.value, bracket);
  }

  /// Concave: the least height is at an end, so the end decides.  Advances node to the end.
  bool concave_piece(Node& node, double stop) {
    const Node last = at(stop);
    if (!(last.value.height > 0)) return crossing(node, last);
    node = last;
    return false;
  }

  /// Convex: falls at most once, so its lowest point decides.
  bool convex_piece(Node& node, double stop) {
    if (node.value.velocity >= 0) {  // rises all the way: no need to look
      node = stop < never ? at(stop) : Node{stop, {}};
      return false;
    }
    const Node last = at(stop);
    if (!(last.value.height > 0)) return crossing(node, last);
    if (last.value.velocity > 0 && turning_point(node, last)) return true;
    node = last;
    return false;
  }

  /// The lowest point between two nodes; true if it lies at or below the ground.
  bool turning_point(const Node& node, const Node& last) {
    const auto sample = [this](double t) -> detail::Sample {
      const auto [height, velocity, scale] = h_.at(t);
      return {velocity, h_.acceleration(t), 0};
    };
    const detail::Root lowest =
        detail::bracketed_root(detail::FunctionView(sample), {node.t, last.t}, lowest_guess(node, last), true);
    found_.evaluations += lowest.evaluations;
    const Node bottom = at(lowest.value);
    const double margin = height_noise * bottom.value.scale;
    if (bottom.value.height > 0) {
      if (bottom.value.height < found_.near_miss.clearance) {
        found_.near_miss.clearance = bottom.value.height;
        found_.near_miss.margin = margin;
        found_.near_miss.time = bottom.t;
      }
      return false;
    }
    found_.within_margin = -bottom.value.height <= margin;
    // From the nearer end: a tangent at the start, a parabola at the lowest point.
    const double tangent = node.t - node.value.height / node.value.velocity;
    const double parabola = bottom.t - std::sqrt(-2 * bottom.value.height / h_.acceleration(bottom.t));
    const bool near_start = node.value.height < -bottom.value.height;
    return solve({node.t, bottom.t}, near_start ? tangent : parabola);
  }

  /// h′ = 0 in closed form with gravity's share taken at the middle of the piece.
  [[nodiscard]] double lowest_guess(const Node& node, const Node& last) const {
    const double middle = std::midpoint(node.t, last.t);
    const double drift = (h_.velocity - h_.gravity * middle) / h_.rate + h_.sine;
    const double sine = std::clamp(-drift / reach_, -1.0, 1.0);
    const double turn = std::remainder(phase_ + std::asin(sine) - h_.rate * middle, 2 * pi);
    return middle + turn / h_.rate;
  }

  const VertexHeight& h_;
  double reach_;
  FirstRoot& found_;
  double phase_;       ///< angle turned at which the curvature is largest
  double half_width_;  ///< of the convex part of a turn, in [0, π]
};

/// The centre of mass as seen in a height function, and the times that bound a search.
struct Centre {
  double height, velocity, gravity, reach;

  explicit Centre(const VertexHeight& h)
      : height(h.height + h.versine), velocity(h.velocity + h.rate * h.sine), gravity(h.gravity),
        reach(std::hypot(h.versine, h.sine)) {}

  /// Last time at which the centre is at this height (infinite if it never comes down to it).
  [[nodiscard]] double falls_through(double level) const {
    const double above = height - level;
    if (gravity < 0) return never;
    if (gravity > 0) {
      const double square = velocity * velocity + 2 * gravity * above;
      if (!(square > 0)) return 0;
      const double root = std::sqrt(square);
      // This is the one of (V + √…)/g and its conjugate that does not cancel.
      return velocity > 0 ? (velocity + root) / gravity : 2 * above / (root - velocity);
    }
    return velocity < 0 ? std::max(above / -velocity, 0.0) : never;
  }
  /// Time from which the centre stays above the vertex's reach, without gravity.
  [[nodiscard]] double clear_for_good() const {
    if (gravity != 0 || !(velocity > 0)) return never;
    return std::max((reach - height) / velocity, 0.0);
  }
};

/// A body that does not turn: a parabola.
FirstRoot parabola_root(const VertexHeight& h, double end) {
  FirstRoot found;
  double t = never;
  if (h.gravity > 0) {
    // From the ground itself without squares: those of the smallest bounces would underflow.
    const double root =
        h.height > 0 ? std::sqrt(h.velocity * h.velocity + 2 * h.gravity * h.height) : std::fabs(h.velocity);
    t = h.velocity > 0 ? (h.velocity + root) / h.gravity : 2 * h.height / (root - h.velocity);
  } else if (h.velocity < 0) {
    t = h.height / -h.velocity;
  }
  if (t > 0 && t <= end && t < never) {
    found.time = found.bracket_low = found.bracket_high = t;
  } else {
    found.near_miss.clearance = h.height > 0 ? h.height : never;
  }
  return found;
}

/// Start of the turn that can hold the first root after a first turn without one.
double second_window(const Centre& centre, double turn) {
  if (centre.gravity < 0) return never;
  if (centre.gravity == 0) return centre.velocity < 0 ? std::max(turn, centre.falls_through(centre.reach)) : never;
  // While V > g (t + turn/2), h(t + turn) > h(t): turns after a clean one are clean as well.
  const double rising = centre.velocity / centre.gravity - turn / 2;
  const double clean = rising > 0 ? rising + turn : turn;
  return std::max(clean, centre.falls_through(centre.reach));
}

}  // namespace

FirstRoot first_root(const VertexHeight& height, double end) {
  const Centre centre(height);
  if (!(height.rate * (height.rate * centre.reach) > 0)) return parabola_root(height, end);
  FirstRoot found;
  found.near_miss.clearance = never;
  const double turn = 2 * pi / height.rate;
  // Below this the vertex is under the ground for certain.
  const double certain = centre.falls_through(-centre.reach);
  // A body that turns slowly is clear long before its turn ends; one that turns fast shows how near
  // it came within that turn.
  const double clear = centre.clear_for_good();
  const double limit = std::min({end, certain, turn > 1e6 * clear ? clear : never});
  Search search(height, centre.reach, found);
  if (search.window(0, std::min(turn, limit)) || !(turn < limit)) return found;
  double start = second_window(centre, turn);
  // The centre comes down, but when and at which phase no double can say.  (The pieces of a turn
  // must also be longer than the steps between doubles there, or the search would stand still.)
  const bool comes_down = centre.gravity > 0 || certain < never;
  const bool told = turn > 8 * epsilon * start && start < certain;
  if (start <= end && comes_down && !told) {
    throw NumericalError("the flight is so long that double precision leaves the phase at its end no digit");
  }
  // The vertex points straight down once in this turn, with the centre no higher than its reach;
  // the second turn is for rounding.
  for (int i = 0; i < 2 && start < limit; ++i, start += turn) {
    if (search.window(start, std::min(start + turn, limit))) return found;
  }
  return found;
}

bool stays_above(const VertexHeight& height, double end, const detail::Turn& turn) {
  constexpr double longest = 3;                    // of half a turn
  constexpr double told = 1.0 / 64, above = 1e-9;  // shares of its size from which the sign of a sum is certain
  const double p = height.versine, q = height.sine, size = told * (std::fabs(p) + std::fabs(q));
  const bool turns = height.rate * (height.rate * size) > 0 && turn.angle < longest;
  if (!(turns && height.height >= 0 && height.gravity >= 0)) return false;
  const auto [last_height, last_velocity, scale] = height.at(end, turn);
  if (!(last_height > above * scale)) return false;
  const double fall = height.gravity / (height.rate * height.rate), cosine = 1 - turn.versine;
  const double first = p - fall, last = p * cosine + q * turn.sine - fall;  // h″/ω² at both ends
  if (!(std::fabs(first) > size && std::fabs(last) > size)) return false;
  // Rises to where it is concave, and from there to an end above the ground; or the other way round.
  if (first > 0) return height.velocity >= 0;
  if (last > 0) return last_velocity <= 0;
  return fall == 0 || q * (q * cosine - p * turn.sine) > 0;  // concave, with no peak of the curvature in between
}

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
  if (departure.angular == 0 || arrival.within_margin || !(std::fabs(arrival.inclination) < turned)) return;
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
    if (std::fabs(height) <= 4 * epsilon * scale && velocity < 0) set |= static_cast<VertexSet>(1u << i);
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
    if (passes_) (*passes_)[vertex] = root.near_miss;
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
