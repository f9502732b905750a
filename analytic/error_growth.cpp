// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/error_growth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "analytic/detail/limits.hpp"
#include "analytic/errors.hpp"

namespace clatter::analytic {

using detail::epsilon;

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
/// Beyond this share of the second order beside the first, the first no longer tells how errors
/// grow.
constexpr double largest_curvature = 0.25;

bool holds(const VertexSet set, int vertex) { return (set >> vertex & 1) != 0; }

}  // namespace

ErrorGrowth::ErrorGrowth(const BodyMotion& motion, double angle) {
  const ContactPoint d = motion.contact_point(std::countr_zero(motion.lowest_vertices()));
  const PlanarVelocity v = motion.velocity();
  const bool exact = motion.local_departure().sine == 0 || d.tangential == 0;  // 0° and 90° are what they are
  const double size = exact ? 0 : std::fabs(angle);
  of_angle_[at_angle] = size;
  of_angle_[at_normal] = v.angular * d.normal * size;
  of_angle_[at_slip] = v.angular * d.tangential * size;
  of_speed_[at_normal] = v.normal;
  StateVector of_slip{}, of_turn{};
  of_slip[at_slip] = v.tangential;
  of_turn[at_turn] = v.angular;
  of_turn[at_normal] = -v.angular * d.tangential;
  of_turn[at_slip] = v.angular * d.normal;
  for (StateVector column : {of_angle_, of_speed_, of_slip, of_turn}) {
    for (double& entry : column) entry *= epsilon;
    factor_.add(column);
  }
}

double ErrorGrowth::bound(const StateVector& gradient, double rounding) const {
  return (alone(gradient) + 2 * rounding) * (1 + curvature_);
}

void ErrorGrowth::advance(const StateMatrix& jacobian) {
  factor_.advance(jacobian);
  of_angle_ = product(jacobian, of_angle_);
  of_speed_ = product(jacobian, of_speed_);
}

/// Another vertex that is as near the ground as the error of its height might have come first.
void ErrorGrowth::check_arrival(const FlownState& flown, const Moment& touch, const Fall& fall) {
  const Arrival& arrival = flown.arrival;
  const StateVector of_first = height_gradient(flown, arrival.vertex, touch);
  for (int i = 0; i < flown.body.vertex_count; ++i) {
    if (i == arrival.vertex) continue;
    const auto [height, velocity, scale] = vertex_height(flown.body, flown.departure, i).at(touch.time, touch.turn);
    const double share = velocity / fall.velocity;
    StateVector gradient = height_gradient(flown, i, touch);
    for (std::size_t k = 0; k < state_size; ++k) gradient[k] -= share * of_first[k];
    const double propagated = alone(gradient);
    const bool together = holds(arrival.vertices, i);
    const double rounding = 4 * epsilon * scale + std::fabs(share) * fall.height_rounding;
    if (together ? !(propagated <= 0) : !(height >= propagated + rounding)) predictable_ = false;
  }
}

/// A vertex that passed the ground within the error of its height might have touched.
void ErrorGrowth::check_passes(const FlownState& flown, const Passes& passes, double until) {
  for (int i = 0; i < flown.body.vertex_count; ++i) {
    NearMiss pass = passes[static_cast<std::size_t>(i)];
    if (pass.time > until) {  // the search looked beyond the arrival of another vertex
      pass = first_root(vertex_height(flown.body, flown.departure, i), until).near_miss;
    }
    if (!std::isfinite(pass.clearance) || (pass.time == 0 && pass.margin == 0)) continue;
    const double error = alone(height_gradient(flown, i, Moment(flown.departure, pass.time)));
    if (!(pass.clearance >= 2 * (error + pass.margin))) predictable_ = false;
  }
}

void ErrorGrowth::end_without_contact(const BodyMotion& motion, const FlownState& flown) {
  if (predictable_) check_passes(flown, motion.passes(), unknown);
}

void ErrorGrowth::fly(const BodyMotion& motion, const FlownState& flown) {
  if (!predictable_) return;
  const Arrival& arrival = flown.arrival;
  const Departure& from = flown.departure;
  const Moment touch(from, arrival.time);
  const FlightDerivatives f = flight_derivatives(flown, touch);
  const VertexHeight height = vertex_height(flown.body, from, arrival.vertex);
  const double reach = std::fabs(height.versine) + std::fabs(height.sine);
  const double turned = touch.turn.angle;
  const double of_phase = turned > 1 ? turned * reach : 0;
  // v₀ is the difference of two parts.
  const ContactPoint offset = from.offset(flown.body, from.reference, arrival.vertex);
  const double of_start = from.rebound_speed + std::fabs(from.angular * offset.tangential);
  const VertexHeight::Value value = height.at(arrival.time, touch.turn);
  const double height_rounding = 2 * epsilon * (value.scale + of_start * arrival.time + of_phase);
  check_arrival(flown, touch, {.velocity = value.velocity, .height_rounding = height_rounding});
  check_passes(flown, motion.passes(), arrival.time);
  if (arrival.within_margin) predictable_ = false;

  StateVector of_height = f.of_time;
  for (double& entry : of_height) entry *= height_rounding / f.velocity;
  advance(f.state);
  factor_.add(of_height);
  const double roundings[] = {arrival.time + motion.time(), turned > 0 ? std::fabs(from.inclination) + turned : 0,
                              of_start + motion.normal_scale(arrival.vertex) + of_phase * std::fabs(from.angular),
                              motion.slip_scale(arrival.vertex)};
  for (std::size_t i = 0; i < 4; ++i) factor_.add(i, epsilon * roundings[i]);
  StateVector speed{}, angle{};
  speed[at_normal] = angle[at_angle] = 1;
  const double late = std::fmax(alone(speed) / std::fabs(f.velocity), alone(angle));
  if (!(late <= largest_curvature)) predictable_ = false;
  curvature_ = std::fmax(curvature_, late);
  if (!predictable_) factor_ = {};
}

double ErrorGrowth::total_impulse() const {
  if (!predictable_) return unknown;
  StateVector sum{};
  sum[at_sum] = 1;
  return bound(sum, epsilon * total_impulse_);
}

void ErrorGrowth::add_to(const BodyMotion& motion, Tail& tail) const {
  if (!predictable_) {
    tail.end_time_error = tail.normal_impulse_error = tail.tangential_impulse_error = unknown;
    tail.after_error = {.normal = unknown, .tangential = unknown, .angular = unknown};
    return;
  }
  const Departure from = motion.local_departure();
  const PlanarVelocity v = motion.velocity();
  const MotionGradients moves(motion.body(), motion.contact_point(from.reference), v, from.gravity);
  StateVector time{}, speed{}, turn{};
  time[at_time] = speed[at_normal] = turn[at_turn] = 1;
  const double relative = bound(speed, 2 * epsilon * from.rebound_speed) / from.rebound_speed;
  tail.end_time_error += bound(time, epsilon * motion.time()) + relative * (tail.end_time - motion.time());
  tail.normal_impulse_error += relative * tail.normal_impulse;
  tail.tangential_impulse_error += relative * std::fabs(tail.tangential_impulse);
  tail.after_error.tangential += bound(moves.tangential, 2 * epsilon * std::fabs(v.tangential)) +
                                 relative * std::fabs(tail.after.tangential - v.tangential);
  if (tail.after.angular == 0) return;
  tail.after_error.normal += bound(moves.normal, 2 * epsilon * std::fabs(v.normal));
  tail.after_error.angular +=
      bound(turn, epsilon * std::fabs(v.angular)) + relative * std::fabs(tail.after.angular - v.angular);
}

}  // namespace clatter::analytic
