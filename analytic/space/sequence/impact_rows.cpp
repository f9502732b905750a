// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/impact_rows.hpp"

#include <cmath>
#include <span>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/landing/level_rim.hpp"

namespace clatter::analytic::space {

using detail::infinite;
using detail::require;
using detail::Scales;
namespace of = detail::of;
namespace {

int exponent_of(double value) { return value > 0 && std::isfinite(value) ? std::ilogb(value) : 0; }

Scales scales_of(const Drop& drop) {
  const double fall = drop.release_height ? std::sqrt(2 * drop.gravity * *drop.release_height) : 0;
  const double vertical = std::fabs(drop.velocity.z()) + fall;
  return {
      .length = exponent_of(drop.body.reach()),
      .speed = exponent_of(vertical > 0 ? vertical : drop.angular_velocity.cwiseAbs().maxCoeff() * drop.body.reach()),
      .mass = exponent_of(drop.body.mass)};
}

void apply(const Scales& scale, State& state) {
  scale(of::length, state.position);
  scale(of::speed, state.velocity);
  scale(of::rate, state.angular_velocity);
}

void apply(const Scales& scale, Impact& impact) {
  scale(of::impulse, impact.impulse, impact.compression_impulse, impact.slip_stop_impulse);
  scale(of::speed, impact.contact_before, impact.contact_after, impact.velocity_after, impact.least_slip,
        impact.approach_speed);
  scale(of::rate, impact.angular_velocity_after);
  scale(of::energy, impact.energy_loss);
}

void apply(const Scales& scale, GroupImpact& group) {
  scale(of::impulse, group.impulse);
  scale(of::angular_impulse, group.moment);
  scale(of::speed, group.velocity_after, group.approach_speed);
  scale(of::rate, group.angular_velocity_after);
  scale(of::energy, group.energy_loss);
}

void apply(const Scales& scale, NearMiss& miss) {
  scale(of::length, miss.clearance, miss.margin);
  scale(of::time, miss.time);
}

void apply(const Scales& scale, FirstContact& flight) {
  scale(of::time, flight.time, flight.time_error, flight.bracket_low, flight.bracket_high);
  scale(of::speed, flight.normal_velocity, flight.velocity_error);
  scale(of::acceleration, flight.acceleration);
  apply(scale, flight.near_miss);
}

void apply(const Scales& scale, ImpactRow& row) {
  for (Corner& corner : row.corners) scale(of::length, corner.place, corner.radius);
  apply(scale, row.before);
  apply(scale, row.impact);
  if (row.group) apply(scale, *row.group);
  scale(of::time, row.start, row.error.start);
  scale(of::speed, row.error.approach_speed, row.error.velocity_after);
  scale(of::impulse, row.error.impulse);
  scale(of::rate, row.error.angular_velocity_after);
  scale(of::energy, row.energy_before, row.energy_after, row.error.energy_before, row.error.energy_after);
  apply(scale, row.flight);
}

void apply(const Scales& scale, Tail& tail) {
  scale(of::time, tail.end_time, tail.end_time_error);
  scale(of::impulse, tail.normal_impulse, tail.normal_impulse_error, tail.tangential_impulse,
        tail.tangential_impulse_error);
  scale(of::energy, tail.energy_loss);
  scale(of::speed, tail.velocity_after, tail.velocity_error);
  scale(of::rate, tail.angular_velocity_after, tail.angular_velocity_error);
}

void apply(const Scales& scale, StateErrors& error) {
  scale(of::time, error.time);
  scale(of::speed, error.velocity);
  scale(of::rate, error.angular_velocity);
}

void apply(const Scales& scale, SustainedContact& contact) {
  scale(of::time, contact.begin, contact.duration);
  if (contact.tail) apply(scale, *contact.tail);
  scale(of::speed, contact.approach_speed);
  apply(scale, contact.after);
  apply(scale, contact.error);
  scale(of::impulse, contact.normal_impulse, contact.normal_impulse_error);
  scale(of::energy, contact.energy_loss);
}

void apply(const Scales& scale, StateAt& at) {
  scale(of::time, at.time);
  apply(scale, at.state);
  apply(scale, at.error);
  scale(of::length, at.position_error);
  scale(of::energy, at.energy, at.energy_error);
}

void apply(const Scales& scale, LastMotion& motion) {
  scale(of::time, motion.begin, motion.begin_error, motion.duration);
  apply(scale, motion.state);
  scale(of::length, motion.distance);
  scale(of::speed, motion.velocity_after);
  scale(of::rate, motion.angular_velocity_after);
}

}  // namespace

SequenceUnits::SequenceUnits(const Drop& drop) : scales_(scales_of(drop)) {}

Drop SequenceUnits::to_internal(Drop drop) const {
  const Scales scale = scales_.inverse();
  scale(of::mass, drop.body.mass);
  scale(of::inertia, drop.body.inertia);
  for (Vector3& vertex : drop.body.vertices) scale(of::length, vertex);
  for (Rim& rim : drop.body.rims) scale(of::length, rim.centre, rim.radius);
  for (Ellipsoid& part : drop.body.ellipsoids) scale(of::length, part.centre, part.semiaxes);
  scale(of::speed, drop.velocity);
  scale(of::rate, drop.angular_velocity);
  scale(of::acceleration, drop.gravity, drop.gravity_along);
  if (drop.release_height) scale(of::length, *drop.release_height);
  scale(of::slowness, drop.law.damping_per_stiffness);
  return drop;
}

SequenceOptions SequenceUnits::to_internal(SequenceOptions options) const {
  const Scales scale = scales_.inverse();
  scale(of::time, options.until);
  return options;
}

double SequenceUnits::to_internal(double time) const {
  scales_.inverse()(of::time, time);
  return time;
}

double SequenceUnits::energy(double internal) const {
  scales_(of::energy, internal);
  return internal;
}

void SequenceUnits::to_si(Sequence& sequence) const {
  if (sequence.last_motion) apply(scales_, *sequence.last_motion);
  for (StateAt& state : sequence.states) apply(scales_, state);
  for (ImpactRow& row : sequence.rows) apply(scales_, row);
  if (sequence.tail) apply(scales_, *sequence.tail);
  for (SustainedContact& contact : sequence.contacts) apply(scales_, contact);
  if (sequence.standing) {
    scales_(of::time, sequence.standing->time);
    apply(scales_, sequence.standing->state);
    apply(scales_, sequence.standing->error);
  }
  scales_(of::energy, sequence.energy_at_end);
  if (sequence.rest) scales_(of::time, sequence.rest->latest);
  apply(scales_, sequence.near_miss);
  scales_(of::acceleration, sequence.end_acceleration);
  scales_(of::impulse, sequence.total_normal_impulse, sequence.total_normal_impulse_error);
  scales_(of::time, sequence.first_flight, sequence.first_flight_error);
}

void Drop::validate() const {
  body.validate();
  law.validate();
  const double touch = touch_height(body, attitude);  // which refuses what is no attitude
  for (int i = 0; i < 3; ++i) {
    require(std::isfinite(velocity[i]), "velocity", velocity[i], "finite");
    require(std::isfinite(angular_velocity[i]), "angular velocity", angular_velocity[i], "finite");
  }
  require(gravity >= 0 && std::isfinite(gravity), "gravity", gravity, "at least 0 and finite");
  require(std::isfinite(gravity_along), "gravity along the ground", gravity_along, "finite");
  if (release_height) {
    require(std::isfinite(*release_height) && *release_height > touch, "release height", *release_height,
            "finite and above that at which the body touches");
  }
}

State given_state(const Drop& drop) {
  return {.position = Vector3(0, 0, drop.release_height.value_or(0)),
          .attitude = drop.attitude.normalized(),
          .velocity = drop.velocity,
          .angular_velocity = drop.angular_velocity};
}

double mechanical_energy(const Drop& drop, const State& state) {
  const Body& body = drop.body;
  const Vector3 w = state.attitude.conjugate() * state.angular_velocity;
  const double potential = drop.gravity * state.position.z() - drop.gravity_along * state.position.x();
  return body.mass * (potential + state.velocity.squaredNorm() / 2) + w.dot(body.inertia * w) / 2;
}

Eigen::Matrix<double, 10, 1> StateErrors::in_each_direction() const {
  Eigen::Matrix<double, 10, 1> all;
  all << time, Vector3::Constant(attitude), Vector3::Constant(velocity), Vector3::Constant(angular_velocity);
  return all;
}

void require_representable(const Sequence& sequence) {
  for (const ImpactRow& row : sequence.rows) {
    const Impact& impact = row.impact;
    if (std::isfinite(row.start) && impact.impulse.allFinite() && impact.velocity_after.allFinite() &&
        impact.angular_velocity_after.allFinite() && std::isfinite(row.energy_after)) {
      continue;
    }
    throw NumericalError("a time, impulse, velocity or energy of the sequence is beyond the doubles");
  }
}

State state_after(const ImpactRow& row) {
  State state = row.before;
  state.velocity = row.impact.velocity_after;
  state.angular_velocity = row.impact.angular_velocity_after;
  return state;
}

void Tail::forget() {
  end_time_error = normal_impulse_error = tangential_impulse_error = infinite;
  velocity_error = angular_velocity_error = infinite;
}

using detail::epsilon;
using detail::missing;

namespace {

Impact impact_of(const GroupImpact& group, const State& before, const Vector3& place) {
  const Vector3 arm = before.attitude * place;
  return {.impulse = group.impulse,
          .contact_before = velocity_at(before, place),
          .contact_after = group.velocity_after + group.angular_velocity_after.cross(arm),
          .approach_speed = group.approach_speed,
          .velocity_after = group.velocity_after,
          .angular_velocity_after = group.angular_velocity_after,
          .compression_impulse = missing,
          .slip_stop_impulse = missing,
          .least_slip = missing,
          .energy_loss = group.energy_loss,
          .path = group.path};
}

/// Without an attitude, which a ball does not need, rounding cannot move its lowest point out of the vertical.
State aligned(const Body& body, State state) {
  if (body.is_ball()) state.attitude.setIdentity();
  return state;
}

/// The impact of several corners of a row.
GroupImpact group_impact(const Body& body, const State& before, const ImpactRow& row, const ImpactLaw& law) {
  if (row.held == 0) return strike_together(body, before, row.corners, law);
  const std::span corners(row.corners);
  return strike_beside(body, before, corners.first(corners.size() - row.held), corners.last(row.held), law);
}

}  // namespace

void strike_row(const Body& body, const ImpactLaw& law, ImpactRow& row, StrikeDerivatives* derivatives) {
  Corner corner = row.corners.front();
  if (row.corners.size() > 1 || corner.radius > 0) {
    row.group = group_impact(body, row.before, row, law);
    row.impact = impact_of(*row.group, row.before, corner.place);
    if (derivatives != nullptr) derivatives->setConstant(missing);
    return;
  }
  const State before = aligned(body, row.before);
  if (body.is_ball()) corner = touching_corner(body, before.attitude, corner.index);
  ContactVelocity velocity = contact_velocity(before, corner.place);
  // Slip that is rounding would have a ball that rolls slip again.
  if (body.is_ball() && velocity.value.head<2>().norm() <= 16 * epsilon * velocity.scale) {
    velocity.value.head<2>().setZero();
  }
  // A small hop knows its normal velocity better; but an impact keeps the energy only with the velocity of its place,
  // which the attitude's rounding turns along a rim that is almost level.
  const double steep = steepness(body, before.attitude, corner.index);
  if (row.flight.time > 0 && row.flight.velocity_error < 2 * epsilon * velocity.scale / steep &&
      std::fabs(row.flight.normal_velocity) <= 1e3 * steep * velocity.scale) {
    velocity.value.z() = row.flight.normal_velocity;
  }
  row.impact = derivatives != nullptr ? strike(body, before, velocity, corner, law, *derivatives)
                                      : strike(body, before, velocity, corner.place, law);
}

Impact struck_again(const Body& body, const ImpactLaw& law, const ImpactRow& row, const State& before) {
  const Corner& corner = row.corners.front();
  if (row.group) return impact_of(group_impact(body, before, row, law), before, corner.place);
  const State state = aligned(body, before);
  return strike(body, state, touching_place(body, state.attitude, corner.index), law);
}

}  // namespace clatter::analytic::space
