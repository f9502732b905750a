// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/point_search.hpp"

#include <algorithm>
#include <cmath>

#include "analytic/errors.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::never_happens;

namespace {

constexpr int most_evaluations_of_a_flight = 1'000'000;

}  // namespace

PointSearch::PointSearch(const Body& body, const FreeFlight& flight)
    : body_(body), flight_(flight), heights_(body, flight), threshold_(heights_.reach() / 20) {
  found_.near_miss.clearance = never_happens;
}

bool PointSearch::look(int point, const Node& a, const Node& b) {
  if (a.point.time >= best_) return true;
  const bool touching = a.point.time == 0 && a.point.height == 0;
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

bool PointSearch::halves(int point, const Node& a, const Node& b) {
  const double middle = a.point.time + (b.point.time - a.point.time) / 2;
  if (!(middle > a.point.time && middle < b.point.time) || b.point.time - a.point.time <= 8 * epsilon * b.point.time) {
    if (b.point.height > 0) return false;
    found_.within_margin = true;
    return take(point, b.point.time, {a.point.time, b.point.time});
  }
  const Node node = at(point, middle);
  if (look(point, a, node)) return true;
  if (!(node.point.height > 0)) return solve_after(point, a, node);
  return look(point, node, b);
}

bool PointSearch::solve_after(int point, const Node& a, const Node& node) {
  found_.within_margin = true;
  return take(point, node.point.time, {a.point.time, node.point.time});
}

bool PointSearch::convex(int point, const Node& a, const Node& b) {
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

bool PointSearch::solve(int point, const Node& a, const Node& b) {
  if (!(a.point.height > 0)) return false;
  const double noise = epsilon * heights_.reach() / 4;
  const auto sample = [&](double t) -> detail::Sample {
    const PointHeight h = at(point, t).point;
    return {h.height, h.velocity, noise};
  };
  const double share = a.point.height / (a.point.height - b.point.height);
  const detail::Root root = detail::bracketed_root(detail::FunctionView(sample), {a.point.time, b.point.time},
                                                   a.point.time + share * (b.point.time - a.point.time), false);
  return take(point, root.value, {a.point.time, b.point.time});
}

bool PointSearch::solve_quotient(int point, const PointHeight& start, const Node& b) {
  const Touch touch{.point = point, .normal_velocity = start.velocity};
  const double turn = b.point.time * flight_.rotation().fastest();
  const std::optional<Vector3> place = hopping_place(body_, flight_, point);
  const double bend = start.acceleration;
  const double guess = bend < 0 ? -2 * touch.normal_velocity / bend : b.point.time / 2;
  if (place && turn <= Hop::largest_turn) {
    hop_.emplace(body_, flight_, *place, touch.normal_velocity);
    const auto sample = [&](double t) -> detail::Sample {
      const Hop::Value value = hop_->at(t);
      return {value.quotient, value.slope, epsilon / 4 * touch.normal_velocity};
    };
    const detail::Root root = detail::bracketed_root(detail::FunctionView(sample), {0, b.point.time}, guess, false);
    hop_time_ = root.value;
    return take(point, root.value, {0, b.point.time});
  }
  if (place && guess * flight_.rotation().fastest() < Hop::largest_turn / 2) {  // the root lies near: come nearer
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

PointSearch::Node PointSearch::at(int point, double time) {
  if (++found_.evaluations > most_evaluations_of_a_flight) {
    throw NumericalError("no contact found nor excluded in a million evaluations of a flight's rotation");
  }
  const FlightMoment moment = heights_.moment(time);
  return {moment, heights_.at(point, moment)};
}

bool PointSearch::take(int point, double time, detail::Bracket bracket) {
  if (!(time < best_)) return true;
  best_ = time;
  found_.end = FlightEnd::contact;
  found_.time = time;
  found_.point = point;
  found_.bracket_low = bracket.low;
  found_.bracket_high = bracket.high;
  return true;
}

double PointSearch::arrival_velocity(const PointHeight& first, double& error) const {
  if (!(best_ > 0 && hop_ && hop_time_ == best_)) return first.velocity;
  const double velocity = hop_->velocity(best_);
  error = 4 * epsilon * std::fabs(velocity);
  return velocity;
}

}  // namespace clatter::analytic::space
