// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/flight/point_height.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analytic/base/limits.hpp"

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
  if (point < static_cast<int>(body_.vertices.size())) return fixed(body_.vertices[static_cast<std::size_t>(point)], 0);
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
  for (std::size_t k = 0; k < 6; ++k) {
    h[k] += e[k].dot(round.centre) - round.radius * round.across(e[k]).norm();
  }
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

}  // namespace clatter::analytic::space
