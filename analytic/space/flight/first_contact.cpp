// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/flight/first_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/base/root_finder.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::infinite;

namespace {

/// max of t³(1 − t)³/6!, t²(1 − t)³/6! and of the error of the second derivative, which interpolates ë at four places:
/// t³(1 − t)/4!.
constexpr double value_error = 1.0 / 46080, quotient_error = 0.03456 / 720, bend_error = 27.0 / 256 / 24;

/// A rim steeper than this has a lowest point; below, the point would be that of an attitude's rounding.
constexpr double level = 64 * epsilon;

/// Bernstein coefficients of the polynomial of degree 5 with given values and derivatives at both ends of s.
template <class T>
std::array<T, 6> coefficients(double s, const T (&start)[3], const T (&end)[3]) {
  const double first = s / 5, second = s * s / 20;
  return {start[0],
          start[0] + first * start[1],
          start[0] + 2 * first * start[1] + second * start[2],
          end[0] - 2 * first * end[1] + second * end[2],
          end[0] - first * end[1],
          end[0]};
}

/// Smallest coefficient; of h/t where h(0) = 0.
double smallest(const std::array<double, 6>& b, double s, bool touching) {
  if (!touching) return *std::min_element(b.begin(), b.end());
  double least = infinite;
  for (std::size_t k = 1; k < 6; ++k) least = std::fmin(least, 5 * b[k] / (static_cast<double>(k) * s));
  return least;
}

}  // namespace

PointHeights::PointHeights(const Body& body, const FreeFlight& flight)
    : body_(body), flight_(flight), reach_(body.reach()) {
  const double w = flight.rotation().fastest(), gamma = flight.rotation().acceleration_factor();
  rates_[0] = 1;
  for (int n = 1; n <= 6; ++n) rates_[n] = rates_[n - 1] * w * (1 + (n - 1) * gamma);
}

FlightMoment PointHeights::moment(double time) const {
  return {time, flight_.centre_height(time), flight_.centre_velocity(time), flight_.rotation().vertical(time)};
}

PointHeight PointHeights::at(int point, const FlightMoment& m) const {
  const Vector3 &e = m.vertical.direction, &rate = m.vertical.rate, &second = m.vertical.second;
  const double gravity = flight_.gravity();
  const auto fixed = [&](const Vector3& r, double lower) -> PointHeight {
    return {m.time, m.centre + e.dot(r) - lower, m.rate + rate.dot(r), second.dot(r) - gravity};
  };
  if (point < static_cast<int>(body_.vertices.size())) return fixed(body_.vertices[point], 0);
  if (const Ellipsoid* sphere = body_.sphere(point)) return fixed(sphere->centre, sphere->semiaxes.x());
  const Round round = body_.round(point);
  const Vector3 &c = round.centre, v = round.across(e), v1 = round.across(rate), v2 = round.across(second);
  const double radius = round.radius;
  const double size = v.norm(), speed = v1.norm();
  double slope = speed, bend = speed > 0 ? v1.dot(v2) / speed : v2.norm();  // of |v₁ t + v₂ t²/2| after t = 0
  if (size > level) {
    slope = v.dot(v1) / size;
    bend = (speed * speed - slope * slope + v.dot(v2)) / size;
  }
  return {m.time, m.centre + e.dot(c) - radius * size, m.rate + rate.dot(c) - radius * slope,
          second.dot(c) - gravity - radius * bend};
}

Corner touching_corner(const Body& body, const Quaternion& attitude, int point) {
  const auto index = static_cast<std::size_t>(point);
  if (index < body.vertices.size()) return {.index = point, .place = body.vertices[index]};
  const Round round = body.round(point);
  const Vector3 e = attitude.conjugate() * Vector3::UnitZ(), v = round.across(e);
  const double size = body.sphere(point) != nullptr ? 1 : v.norm();
  if (round.is_rim() && size <= level) return {.index = point, .place = round.centre, .radius = round.radius};
  return {.index = point, .place = round.centre - round.radius / size * round.twice(v)};
}

double steepness(const Body& body, const Quaternion& attitude, int point) {
  const auto index = static_cast<std::size_t>(point);
  if (index < body.vertices.size() || body.sphere(point) != nullptr) return 1;
  return body.round(point).across(attitude.conjugate() * Vector3::UnitZ()).norm();
}

double PointHeights::depth(int point) const {
  const auto index = static_cast<std::size_t>(point);
  if (index < body_.vertices.size()) return flight_.rotation().depth(body_.vertices[index]);
  const Round round = body_.round(point);
  return round.is_rim() ? reach_ : flight_.rotation().depth(round.centre) + round.radius;
}

double PointHeights::noise(double time) const {
  const State& start = flight_.start();
  return 16 * epsilon *
         (reach_ + std::fabs(start.position.z()) +
          time * (std::fabs(start.velocity.z()) + flight_.gravity() / 2 * time));
}

double PointHeights::lowest_between(const FlightMoment& a, const FlightMoment& b) const {
  const Vector3& axis = flight_.rotation().spin_axis();
  const double first = a.vertical.direction.dot(axis), last = b.vertical.direction.dot(axis);
  const double turn = flight_.rotation().axis_speed() * (b.time - a.time) / 2;
  const double low = std::fmax((first + last) / 2 - turn, -1.0), high = std::fmin((first + last) / 2 + turn, 1.0);
  double deepest = 0;
  const auto reaches = [&](double along, double across) {
    deepest = std::fmax(deepest, across - std::fmin(along * low, along * high));
  };
  for (const Vector3& r : body_.vertices) reaches(r.dot(axis), (r - r.dot(axis) * axis).norm());
  for (const auto& [c, normal, radius] : body_.rims) {
    const double along = c.dot(axis), tilt = normal.cross(axis).norm();
    reaches(along, (c - along * axis).norm() + radius);
    if (tilt > 0) reaches(along, (c - along * axis).norm() + radius * (1 + tilt));
  }
  for (const auto& [c, semiaxes] : body_.ellipsoids) {
    const double along = c.dot(axis);
    deepest =
        std::fmax(deepest, (c - along * axis).norm() - std::fmin(along * low, along * high) + semiaxes.maxCoeff());
  }
  return std::fmin(a.centre, b.centre) - deepest - noise(b.time);
}

double PointHeights::lowest_of_vertex(const Piece& piece, double tolerance) const {
  const PointHeight &a = piece.from, &b = piece.to;
  const double s = b.time - a.time;
  const double start[3] = {a.height, a.velocity, a.acceleration}, end[3] = {b.height, b.velocity, b.acceleration};
  return smallest(coefficients(s, start, end), s, piece.touching) - tolerance;
}

/// With the coefficients of v in place of v: the bound is exact at the ends only.
double PointHeights::lowest_of_round(const Round& round, const Piece& piece, double tolerance) const {
  const FlightMoment &a = piece.start, &b = piece.end;
  const double s = b.time - a.time;
  const Vector3 start[3] = {a.vertical.direction, a.vertical.rate, a.vertical.second};
  const Vector3 end[3] = {b.vertical.direction, b.vertical.rate, b.vertical.second};
  const auto e = coefficients(s, start, end);
  const double fall[3] = {a.centre, a.rate, -flight_.gravity()}, fell[3] = {b.centre, b.rate, -flight_.gravity()};
  auto h = coefficients(s, fall, fell);
  for (std::size_t k = 0; k < 6; ++k) h[k] += e[k].dot(round.centre) - round.radius * round.across(e[k]).norm();
  // What is known of the start better than its terms.
  const double known = piece.from.height - h[0];
  for (double& height : h) height += known;
  return smallest(h, s, piece.touching) - tolerance;
}

void PointHeights::bend_of_vertex(const Piece& piece, HeightBounds& bounds) const {
  const PointHeight &a = piece.from, &b = piece.to;
  const double s = b.time - a.time;
  const double near = reach_ * rates_[3] * s / 2;
  bounds.least_bend = std::fmin(a.acceleration, b.acceleration) - near;
  bounds.largest_bend = std::fmax(a.acceleration, b.acceleration) + near;
  if (!(s * s > 1e-8 * reach_ * rates_[2])) return;
  // Second differences of the coefficients, as long as rounding leaves them digits.
  const double start[3] = {a.height, a.velocity, a.acceleration}, end[3] = {b.height, b.velocity, b.acceleration};
  const auto c = coefficients(s, start, end);
  double least = infinite, largest = -infinite;
  for (std::size_t k = 0; k < 4; ++k) {
    const double bend = 20 / (s * s) * (c[k + 2] - 2 * c[k + 1] + c[k]);
    least = std::fmin(least, bend);
    largest = std::fmax(largest, bend);
  }
  const double tolerance = bend_error * reach_ * rates_[6] * s * s * s * s + 160 / (s * s) * noise(b.time);
  bounds.least_bend = std::fmax(bounds.least_bend, least - tolerance);
  bounds.largest_bend = std::fmin(bounds.largest_bend, largest + tolerance);
}

/// From f = |v|: f f′ = v·v′, f′² + f f″ = |v′|² + v·v″ (so that f″ >= −|v″|), 3 f′f″ + f f‴ = 3 v′·v″ + v·v‴.
void PointHeights::bend_of_round(const Round& round, const Piece& piece, HeightBounds& bounds) const {
  const PointHeight &a = piece.from, &b = piece.to;
  const double s = b.time - a.time;
  const auto across = [&](const FlightMoment& m) { return round.across(m.vertical.direction).norm(); };
  const double least = round.is_rim() ? 0 : round.shares.minCoeff();
  const double size = std::fmax(std::fmax(across(piece.start), across(piece.end)) - rates_[1] * s, least);
  const auto pull = [&](const FlightMoment& m) { return round.across(m.vertical.second).norm(); };
  const auto lift = [&](const FlightMoment& m) { return m.vertical.second.dot(round.centre) + round.radius * pull(m); };
  const double drift = (round.centre.norm() + round.radius) * rates_[3] * s / 2;
  bounds.least_bend = -infinite;
  bounds.largest_bend = std::fmax(lift(piece.start), lift(piece.end)) - flight_.gravity() + drift;
  const FreeRotation& rotation = flight_.rotation();
  const double off_axis = round.centre.cross(round.axis).norm(),
               off_spin = round.axis.cross(rotation.spin_axis()).norm();
  if (round.is_rim() && off_axis <= 4 * epsilon * reach_ && off_spin <= 4 * epsilon) {
    // The axis is all that moves, however fast the body spins about this axis.
    const double turning = rotation.axis_speed() + 8 * epsilon * rotation.fastest();
    const double most = 2 * (round.centre.norm() + round.radius) * turning * rotation.fastest() - flight_.gravity();
    bounds.largest_bend = std::fmin(bounds.largest_bend, most);
  }
  if (!(size > 0)) return;
  const double third = rates_[3] + 3 * rates_[1] * (2 * rates_[2] + rates_[1] * rates_[1] / size) / size;
  const double near = (round.centre.norm() * rates_[3] + round.radius * third) * s / 2;
  bounds.least_bend = std::fmin(a.acceleration, b.acceleration) - near;
  bounds.largest_bend = std::fmin(bounds.largest_bend, std::fmax(a.acceleration, b.acceleration) + near);
}

HeightBounds PointHeights::bounds(int point, const Piece& piece) const {
  const double s = piece.to.time - piece.from.time;
  const double sixth = rates_[6] * reach_ * s * s * s * s * s;
  const double rounding = noise(piece.to.time);
  const double tolerance =
      piece.touching ? quotient_error * sixth + 2 * rounding / s : value_error * sixth * s + rounding;
  HeightBounds bounds;
  if (is_round(point)) {
    const Round round = body_.round(point);
    bounds.lowest = lowest_of_round(round, piece, tolerance);
    bend_of_round(round, piece, bounds);
  } else {
    bounds.lowest = lowest_of_vertex(piece, tolerance);
    bend_of_vertex(piece, bounds);
  }
  return bounds;
}

using detail::never;

constexpr int most_evaluations_of_a_flight = 1'000'000;

// Height of a point that has just left the ground, as a series in time.

/// h(t) = t (u + t C(t) − ρ t S(t)), so that a hop keeps its relative accuracy however small its speed u beside V_z.
/// C comes from the Taylor series of e = Aᵀ z and ω at t = 0 (Euler's equations), with the place of a vertex or the
/// centre of a rim or ellipsoid.  ρ S is their share: with v = v₀ + v₁ t + V t² of (2) in the header, of size s, and
/// s₁ = v₀·v₁/s₀ the derivative of s at t = 0,
///     S = (s − s₀ − s₁ t)/t² = (|v₀ × v₁|²/s₀² + 2 (v₀ + v₁ t)·V + t² V²)/(s + s₀ + s₁ t),         (4)
/// where only the second form has its digits unless s₀ + s₁ t < 0.
/// Domain: |ω| t <= 0.1, where 16 terms leave a few ulp.
class Hop {
 public:
  static constexpr double largest_turn = 0.1;  ///< [rad]

  /// The bounce of a vertex or the lowest point of a rim or ellipsoid, which leaves with the normal velocity `speed`.
  Hop(const Body& body, const FreeFlight& flight, int point, double speed) : speed_(speed) {
    const Matrix3& inertia = body.inertia;
    const Matrix3 inverse = inertia.inverse();
    const State& start = flight.start();
    const auto index = static_cast<std::size_t>(point);
    const Ellipsoid* const sphere = body.sphere(point);
    const bool is_round = index >= body.vertices.size() && sphere == nullptr;
    std::array<Vector3, terms + 2> e, w, momentum;
    // Rounding of e turns the lowest point of a rim near level: that of the departure's is taken, which `speed` is of.
    e[0] = is_round ? start.attitude.conjugate() * Vector3::UnitZ() : flight.rotation().vertical(0).direction;
    w[0] = flight.rotation().angular_velocity(0);
    momentum[0] = inertia * w[0];
    for (std::size_t n = 0; n + 1 < e.size(); ++n) {
      Vector3 turn = Vector3::Zero(), torque = Vector3::Zero();
      for (std::size_t k = 0; k <= n; ++k) {
        turn += e[k].cross(w[n - k]);
        torque += momentum[k].cross(w[n - k]);
      }
      const double next = static_cast<double>(n + 1);
      e[n + 1] = turn / next;
      momentum[n + 1] = torque / next;
      w[n + 1] = inverse * momentum[n + 1];
    }
    const Vector3 place = is_round            ? body.round(point).centre
                          : sphere != nullptr ? sphere->centre
                                              : body.vertices[index];
    for (std::size_t k = 0; k < terms; ++k) bends_[k] = e[k + 2].dot(place);
    bends_[0] -= flight.gravity() / 2;
    if (!is_round) return;
    const bool level = touching_corner(body, start.attitude, point).radius > 0;
    const Vector3& spin = start.angular_velocity;
    if (level && spin.head<2>().norm() <= 64 * epsilon * std::fabs(spin.z())) return;  // it stays level
    const Round round = body.round(point);
    radius_ = round.radius;
    start_ = level ? Vector3(Vector3::Zero()) : round.across(e[0]);
    rate_ = round.across(e[1]);
    for (std::size_t k = 0; k < terms; ++k) across_[k] = round.across(e[k + 2]);
    size_ = start_.norm();
    growth_ = level ? rate_.norm() : start_.dot(rate_) / size_;
    turn_ = level ? 0 : (start_ / size_).cross(rate_).squaredNorm();
  }

  struct Value {
    double quotient = 0;  ///< h/t [m/s]
    double slope = 0;     ///< its derivative [m/s²]
  };

  [[nodiscard]] Value at(double time) const {
    double bend = 0, slope = 0;
    for (std::size_t k = terms; k-- > 0;) {
      slope = slope * time + bend;
      bend = bend * time + bends_[k];
    }
    if (radius_ > 0) {
      const Share share = share_of_round(time);
      bend -= radius_ * share.value;
      slope -= radius_ * share.slope;
    }
    return {.quotient = speed_ + time * bend, .slope = bend + time * slope};
  }

  /// h′ [m/s].
  [[nodiscard]] double velocity(double time) const {
    const Value value = at(time);
    return value.quotient + time * value.slope;
  }

  /// Rounding error of h/t, but for that of its terms [m/s].
  [[nodiscard]] double noise() const { return detail::epsilon / 4 * speed_; }

 private:
  static constexpr std::size_t terms = 16;
  struct Share {
    double value = 0, slope = 0;
  };
  /// S of (4) and its derivative.
  [[nodiscard]] Share share_of_round(double time) const {
    Vector3 bend = Vector3::Zero(), change = Vector3::Zero();  // V, V′
    for (std::size_t k = terms; k-- > 0;) {
      change = change * time + bend;
      bend = bend * time + across_[k];
    }
    const Vector3 line = start_ + time * rate_, v = line + time * time * bend;
    const Vector3 rate = rate_ + time * (2 * bend + time * change);
    const double size = v.norm(), straight = size_ + growth_ * time;
    const double growth = size > 0 ? v.dot(rate) / size : rate.norm();
    if (straight < 0) {
      const double value = (size - straight) / (time * time);
      return {value, (growth - growth_) / (time * time) - 2 * value / time};
    }
    const double sum = size + straight;
    if (!(sum > 0)) return {};
    const double value = (turn_ + 2 * line.dot(bend) + time * time * bend.squaredNorm()) / sum;
    const double slope = 2 * (rate_.dot(bend) + line.dot(change) + time * (bend + time * change).dot(bend));
    return {value, (slope - value * (growth + growth_)) / sum};
  }

  double speed_;
  std::array<double, terms> bends_{};  ///< of C
  double radius_ = 0;                  ///< ρ; 0: a vertex, a sphere, or a rim that stays level
  double size_ = 0, growth_ = 0;       ///< s₀, s₁
  double turn_ = 0;                    ///< |v₀ × v₁|²/s₀²
  Vector3 start_, rate_;               ///< v₀, v₁
  std::array<Vector3, terms> across_;  ///< of V
};

// The first root of the height of a body's point in a piece of a flight, certified by bounds of its second derivative.

/// Looks at one point after another and keeps the earliest contact, and the nearest miss, of all that it has seen.
class PointSearch {
 public:
  /// A moment of a point.
  struct Node {
    FlightMoment moment;
    PointHeight point;
  };

  PointSearch(const Body& body, const FreeFlight& flight)
      : body_(body), flight_(flight), heights_(body, flight), threshold_(heights_.reach() / 20) {
    found_.near_miss.clearance = never;
  }

  /// Looks for the point's first root in a piece, unless one before it is known.  True when one was found.
  bool look(int point, const Node& a, const Node& b) {
    if (a.point.time >= best_) return true;
    const bool touching = a.point.time == 0 && a.point.height == 0;
    if (touching && heights_.is_round(point)) {
      if (hopping_round_ != point) hop_.emplace(body_, flight_, point, a.point.velocity);
      hopping_round_ = point;
      if (!hops(point, b.point.time))
        return split(point, a, b, 0.99 * Hop::largest_turn / flight_.rotation().fastest());
    }
    const HeightBounds bounds = heights_.bounds(point, {a.moment, b.moment, a.point, b.point, touching});
    if (bounds.lowest > (touching ? 0 : std::fmin(threshold_, found_.near_miss.clearance))) return false;
    if (touching) {
      // (h/t)′ = h″/2 somewhere before.
      if (bounds.least_bend >= 0) return false;
      if (bounds.largest_bend <= 0) return b.point.height < 0 ? solve_quotient(point, a.point, b) : false;
    } else if (bounds.largest_bend <= 0) {
      return b.point.height <= 0 ? solve(point, a, b) : false;
    } else if (bounds.least_bend >= 0) {
      return convex(point, a, b);
    } else {
      const double length = b.point.time - a.point.time;
      if (a.point.velocity + bounds.largest_bend * length < 0) return b.point.height <= 0 ? solve(point, a, b) : false;
      if (a.point.velocity + bounds.least_bend * length > 0) return false;
    }
    return halves(point, a, b);
  }

  /// Takes the time as the point's contact, unless one before it is known; true.
  bool take(int point, double time, detail::Bracket bracket) {
    if (!(time < best_)) return true;
    best_ = time;
    found_.end = FlightEnd::contact;
    found_.time = time;
    found_.point = point;
    found_.bracket_low = bracket.low;
    found_.bracket_high = bracket.high;
    return true;
  }

  /// Takes the end of a piece in which the point went below the ground from a height that was rounding.
  bool take_end(int point, double from, double time) {
    found_.within_margin = true;
    return take(point, time, {from, time});
  }

  [[nodiscard]] PointHeights& heights() { return heights_; }
  [[nodiscard]] FirstContact& found() { return found_; }
  /// Time of the earliest contact so far.
  [[nodiscard]] double best() const { return best_; }
  /// Clearances from here on are no near miss.
  [[nodiscard]] double threshold() const { return threshold_; }
  /// Normal velocity of the point that arrives first; of a small hop that of its series.
  /// @param first  the point at the contact
  [[nodiscard]] double arrival_velocity(const PointHeight& first) const {
    return hopped() ? hop_velocity_ : first.velocity;
  }

  /// Whether the contact is a hop's: as accurate, relatively, as the speed with which the point departed.
  [[nodiscard]] bool hopped() const { return best_ > 0 && hop_time_ == best_; }

 private:
  bool halves(int point, const Node& a, const Node& b) {
    const double middle = a.point.time + (b.point.time - a.point.time) / 2;
    if (!(middle > a.point.time && middle < b.point.time) ||
        b.point.time - a.point.time <= 8 * epsilon * b.point.time) {
      return b.point.height > 0 ? false : take_end(point, a.point.time, b.point.time);
    }
    return split(point, a, b, middle);
  }

  bool split(int point, const Node& a, const Node& b, double middle) {
    const Node node = at(point, middle);
    if (look(point, a, node)) return true;
    if (!(node.point.height > 0)) return take_end(point, a.point.time, node.point.time);
    return look(point, node, b);
  }

  bool convex(int point, const Node& a, const Node& b) {
    if (b.point.height <= 0) return solve(point, a, b);
    if (!(a.point.velocity < 0 && b.point.velocity > 0)) return false;
    const auto sample = [&](double t) -> detail::Sample {
      const PointHeight h = at(point, t).point;
      return {h.velocity, h.acceleration, 0};
    };
    const double share = a.point.velocity / (a.point.velocity - b.point.velocity);
    const detail::Root root = detail::bracketed_root(detail::FunctionView(sample), {a.point.time, b.point.time},
                                                     a.point.time + share * (b.point.time - a.point.time), true);
    const Node bottom = at(point, root.value);
    const double margin = heights_.noise(root.value);
    if (bottom.point.height > 0) {
      if (bottom.point.height < found_.near_miss.clearance) {
        found_.near_miss = {.clearance = bottom.point.height, .margin = margin, .time = root.value, .vertex = point};
      }
      return false;
    }
    const bool slight = -bottom.point.height <= margin;
    if (slight && !(bottom.point.time > a.point.time)) return false;
    if (!solve(point, a, bottom)) return false;
    found_.within_margin = slight;
    return true;
  }

  bool solve(int point, const Node& a, const Node& b) {
    if (!(a.point.height > 0)) return false;
    const double noise = epsilon * heights_.reach() / 4;
    const bool hopping = hops(point, b.point.time);
    const auto sample = [&](double t) -> detail::Sample {
      const PointHeight h = at(point, t).point;
      return {h.height, h.velocity, hopping ? hop_->noise() * t : noise};
    };
    const double share = a.point.height / (a.point.height - b.point.height);
    const detail::Root root = detail::bracketed_root(detail::FunctionView(sample), {a.point.time, b.point.time},
                                                     a.point.time + share * (b.point.time - a.point.time), false);
    const detail::Bracket bracket{a.point.time, b.point.time};
    return hopping ? take_hop(point, root.value, bracket) : take(point, root.value, bracket);
  }

  /// Root of h/t in (0, b].
  bool solve_quotient(int point, const PointHeight& start, const Node& b) {
    const Touch touch{.point = point, .normal_velocity = start.velocity};
    const double turn = b.point.time * flight_.rotation().fastest();
    const double bend = start.acceleration;
    const double guess = bend < 0 ? -2 * touch.normal_velocity / bend : b.point.time / 2;
    if (turn <= Hop::largest_turn) {
      if (!hops(point, 0)) {
        hop_.emplace(body_, flight_, point, touch.normal_velocity);
        hopping_round_ = -1;
      } else if (!(hop_->at(b.point.time).quotient < 0)) {
        return false;
      }
      const auto sample = [&](double t) -> detail::Sample {
        const Hop::Value value = hop_->at(t);
        return {value.quotient, value.slope, hop_->noise()};
      };
      const detail::Root root = detail::bracketed_root(detail::FunctionView(sample), {0, b.point.time}, guess, false);
      return take_hop(point, root.value, {0, b.point.time});
    }
    if (guess * flight_.rotation().fastest() < Hop::largest_turn / 2) {  // the root lies near: come nearer
      const Node nearer = at(point, Hop::largest_turn * 0.99 / flight_.rotation().fastest());
      if (nearer.point.height < 0) return solve_quotient(point, start, nearer);
    }
    // h/t >= u − max|h″| t/2 has no root before this.
    const double bound = heights_.reach() * heights_.rate_bound(2) + flight_.gravity();
    const double low = std::fmin(touch.normal_velocity / bound, b.point.time / 2);
    const double noise = epsilon * heights_.reach() / 4;
    const auto sample = [&](double t) -> detail::Sample {
      const PointHeight h = at(point, t).point;
      return {h.height / t, (h.velocity - h.height / t) / t, noise / t};
    };
    const bool inside = guess > low && guess < b.point.time;
    const detail::Root root = detail::bracketed_root(detail::FunctionView(sample), {low, b.point.time},
                                                     inside ? guess : (low + b.point.time) / 2, false);
    return take(point, root.value, {low, b.point.time});
  }

  Node at(int point, double time) {
    if (++found_.evaluations > most_evaluations_of_a_flight) {
      throw NumericalError("no contact found nor excluded in a million evaluations of a flight's rotation");
    }
    const FlightMoment moment = heights_.moment(time);
    Node node{moment, heights_.at(point, moment)};
    if (time > 0 && hops(point, time)) {
      const Hop::Value value = hop_->at(time);
      node.point.height = time * value.quotient;
      node.point.velocity = value.quotient + time * value.slope;
    }
    return node;
  }

  /// Whether the point is the rim or ellipsoid that hop_ is of, at a time in its domain.
  [[nodiscard]] bool hops(int point, double time) const {
    return point == hopping_round_ && time * flight_.rotation().fastest() <= Hop::largest_turn;
  }
  /// Takes a root of hop_.
  bool take_hop(int point, double time, detail::Bracket bracket) {
    if (time < best_) {
      hop_time_ = time;
      hop_velocity_ = hop_->velocity(time);
    }
    return take(point, time, bracket);
  }

  const Body& body_;
  const FreeFlight& flight_;
  PointHeights heights_;
  FirstContact found_;
  std::optional<Hop> hop_;
  int hopping_round_ = -1;
  double hop_time_ = -1, hop_velocity_ = 0;
  double best_ = detail::never, threshold_;
};

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
      // Impacts of others may have left it below the ground by more than this flight's rounding.
      if (known || h.height <= heights_.noise(0)) h.height = 0;
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
    const bool ever_falls = falls < never;
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
    const bool periodic_hover = end == never && flight_.gravity() == 0 && !(flight_.start().velocity.z() < 0);
    if (speed == 0) {
      if (end < never) return pieces(start, end, end);
      return true;  // a body that neither turns nor falls
    }
    if (periodic_hover && flight_.rotation().is_steady()) end = start.time + 2 * std::numbers::pi / speed;
    return stretch(start, end, piece_angle / speed);
  }

  /// Leaves out what is clear whatever the spin, so that many turns far above the ground cost little.
  bool stretch(FlightMoment& start, double end, double length) {
    if (!(end - start.time > shortest_stretch * length) || end == never) return pieces(start, end, length);
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
        if (!(lowest <= depths_[i])) continue;
        const int point = static_cast<int>(i);
        if (search_.look(point, {start, from_[i]}, {next, to_[i]})) continue;
        if (to_[i].height < -heights_.noise(stop)) search_.take_end(point, start.time, stop);
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
    // A point that only lay on the ground, and was not struck, leaves with no better speed than that of its parts.
    const Touch* const departed = search_.hopped() ? touch(found_.point) : nullptr;
    const PointHeight first = best == 0 ? from_[found_.point] : heights_.at(found_.point, moment);
    found_.normal_velocity = search_.arrival_velocity(first);
    found_.velocity_error = 4 * epsilon * (departed != nullptr ? std::fabs(found_.normal_velocity) : parts);
    if (search_.hopped() && heights_.is_round(found_.point)) {
      // Rounding of the attitude turns the lowest point of a rim by that over the rim's steepness.
      const double steep =
          std::fmin(heights_.steepness(found_.point, heights_.moment(0)), heights_.steepness(found_.point, moment));
      if (departed != nullptr) found_.velocity_error += 4 * epsilon * std::fabs(departed->normal_velocity);
      found_.velocity_error /= steep;
    }
    found_.acceleration = first.acceleration;
    found_.together.assign(1, found_.point);
    found_.is_hop = departed != nullptr;
    found_.time_error = found_.is_hop ? best * found_.velocity_error / std::fabs(found_.normal_velocity)
                                      : heights_.noise(best) / std::fabs(first.velocity);
    // The others' heights err by the time's error, too.
    // A graze errs by the square of that time, and never beside a departure that was later.
    const double noise = heights_.noise(best);
    const double late = found_.is_hop ? 4 * epsilon * best
                                      : std::fmin(std::fmin(noise / std::fabs(first.velocity), best),
                                                  std::sqrt(2 * noise / std::fabs(first.acceleration)));
    for (int i = 0; i < heights_.count(); ++i) {
      if (i == found_.point) continue;
      const PointHeight h = best == 0 ? from_[i] : heights_.at(i, moment);
      if (h.height <= noise + late * std::fabs(h.velocity) && h.velocity < 0) found_.together.push_back(i);
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
  const bool turns = !body.is_centred_sphere();
  const std::optional<double> across = turns ? body.transverse_moment() : std::nullopt;
  if (turns && !across) return Search(body, flight, touching).run();
  const State& start = flight.start();
  State steady = start;
  if (!turns) {  // a parabola, whatever the spin
    steady.angular_velocity.setZero();
    return Search(body, FreeFlight(PrincipalAxes(body.inertia), steady, flight.gravity()), touching).run();
  }
  Body shape = body;
  shape.inertia = *across * Matrix3::Identity();
  const Vector3 spin = start.attitude.conjugate() * start.angular_velocity;
  steady.angular_velocity = start.attitude * (body.inertia * spin) / *across;
  return Search(shape, FreeFlight(PrincipalAxes(shape.inertia), steady, flight.gravity()), touching).run();
}

}  // namespace clatter::analytic::space
