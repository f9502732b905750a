// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/impact_rows.hpp"

#include <cmath>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::infinite;
using detail::require;
namespace {

void scale(double& value, int exponent) { value = std::ldexp(value, exponent); }

template <class Derived>
void scale(Eigen::MatrixBase<Derived>& value, int exponent) {
  for (Eigen::Index i = 0; i < value.rows(); ++i) {
    for (Eigen::Index j = 0; j < value.cols(); ++j) value(i, j) = std::ldexp(value(i, j), exponent);
  }
}

int exponent_of(double value) { return value > 0 && std::isfinite(value) ? std::ilogb(value) : 0; }

}  // namespace

SequenceUnits::SequenceUnits(const Drop& drop)
    : length_(exponent_of(drop.body.reach())), mass_(exponent_of(drop.body.mass)) {
  const double fall = drop.release_height ? std::sqrt(2 * drop.gravity * *drop.release_height) : 0;
  const double vertical = std::fabs(drop.velocity.z()) + fall;
  speed_ = exponent_of(vertical > 0 ? vertical : drop.angular_velocity.cwiseAbs().maxCoeff() * drop.body.reach());
}

Drop SequenceUnits::to_internal(const Drop& drop) const {
  Drop d = drop;
  scale(d.body.mass, -mass_);
  scale(d.body.inertia, -mass_ - 2 * length_);
  for (Vector3& vertex : d.body.vertices) scale(vertex, -length_);
  for (Rim& rim : d.body.rims) {
    scale(rim.centre, -length_);
    scale(rim.radius, -length_);
  }
  for (Ellipsoid& part : d.body.ellipsoids) {
    scale(part.centre, -length_);
    scale(part.semiaxes, -length_);
  }
  scale(d.velocity, -speed_);
  scale(d.angular_velocity, length_ - speed_);
  scale(d.gravity, length_ - 2 * speed_);
  scale(d.gravity_along, length_ - 2 * speed_);
  if (d.release_height) scale(*d.release_height, -length_);
  scale(d.law.law.damping_per_stiffness, speed_);
  return d;
}

SequenceOptions SequenceUnits::to_internal(const SequenceOptions& options) const {
  SequenceOptions o = options;
  scale(o.until, speed_ - length_);
  for (double& time : o.times) scale(time, speed_ - length_);
  return o;
}

double SequenceUnits::energy(double internal) const { return std::ldexp(internal, mass_ + 2 * speed_); }

void SequenceUnits::to_si(State& state) const {
  scale(state.position, length_);
  scale(state.velocity, speed_);
  scale(state.angular_velocity, speed_ - length_);
}

void SequenceUnits::to_si(Impact& impact) const {
  scale(impact.impulse, mass_ + speed_);
  scale(impact.contact_before, speed_);
  scale(impact.contact_after, speed_);
  scale(impact.velocity_after, speed_);
  scale(impact.angular_velocity_after, speed_ - length_);
  scale(impact.compression_impulse, mass_ + speed_);
  scale(impact.slip_stop_impulse, mass_ + speed_);
  scale(impact.least_slip, speed_);
  scale(impact.energy_loss, mass_ + 2 * speed_);
}

void SequenceUnits::to_si(GroupImpact& group) const {
  scale(group.impulse, mass_ + speed_);
  scale(group.moment, mass_ + speed_ + length_);
  scale(group.velocity_after, speed_);
  scale(group.angular_velocity_after, speed_ - length_);
  scale(group.approach_speed, speed_);
  scale(group.energy_loss, mass_ + 2 * speed_);
}

void SequenceUnits::to_si(NearMiss& miss) const {
  scale(miss.clearance, length_);
  scale(miss.margin, length_);
  scale(miss.time, length_ - speed_);
}

void SequenceUnits::to_si(FirstContact& flight) const {
  scale(flight.time, length_ - speed_);
  scale(flight.time_error, length_ - speed_);
  scale(flight.bracket_low, length_ - speed_);
  scale(flight.bracket_high, length_ - speed_);
  scale(flight.normal_velocity, speed_);
  scale(flight.velocity_error, speed_);
  scale(flight.acceleration, 2 * speed_ - length_);
  to_si(flight.near_miss);
}

void SequenceUnits::to_si(ImpactRow& row) const {
  scale(row.start, length_ - speed_);
  for (Corner& corner : row.corners) {
    scale(corner.place, length_);
    scale(corner.radius, length_);
  }
  to_si(row.before);
  to_si(row.impact);
  if (row.group) to_si(*row.group);
  scale(row.approach_speed, speed_);
  scale(row.energy_before, mass_ + 2 * speed_);
  scale(row.energy_after, mass_ + 2 * speed_);
  scale(row.error.start, length_ - speed_);
  scale(row.error.approach_speed, speed_);
  scale(row.error.impulse, mass_ + speed_);
  scale(row.error.velocity_after, speed_);
  scale(row.error.angular_velocity_after, speed_ - length_);
  scale(row.error.energy_before, mass_ + 2 * speed_);
  scale(row.error.energy_after, mass_ + 2 * speed_);
  to_si(row.flight);
}

void SequenceUnits::to_si(Tail& tail) const {
  scale(tail.end_time, length_ - speed_);
  scale(tail.end_time_error, length_ - speed_);
  scale(tail.normal_impulse, mass_ + speed_);
  scale(tail.normal_impulse_error, mass_ + speed_);
  scale(tail.tangential_impulse, mass_ + speed_);
  scale(tail.tangential_impulse_error, mass_ + speed_);
  scale(tail.energy_loss, mass_ + 2 * speed_);
  scale(tail.velocity_after, speed_);
  scale(tail.velocity_error, speed_);
  scale(tail.angular_velocity_after, speed_ - length_);
  scale(tail.angular_velocity_error, speed_ - length_);
}

void SequenceUnits::to_si(StateErrors& error) const {
  scale(error.time, length_ - speed_);
  scale(error.velocity, speed_);
  scale(error.angular_velocity, speed_ - length_);
}

void SequenceUnits::to_si(SustainedContact& contact) const {
  scale(contact.begin, length_ - speed_);
  scale(contact.duration, length_ - speed_);
  if (contact.tail) to_si(*contact.tail);
  scale(contact.approach_speed, speed_);
  to_si(contact.after);
  to_si(contact.error);
  scale(contact.normal_impulse, mass_ + speed_);
  scale(contact.normal_impulse_error, mass_ + speed_);
  scale(contact.energy_loss, mass_ + 2 * speed_);
}

void SequenceUnits::to_si(StateAt& at) const {
  scale(at.time, length_ - speed_);
  to_si(at.state);
  to_si(at.error);
  scale(at.position_error, length_);
  scale(at.energy, mass_ + 2 * speed_);
  scale(at.energy_error, mass_ + 2 * speed_);
}

void SequenceUnits::to_si(LastMotion& motion) const {
  scale(motion.begin, length_ - speed_);
  to_si(motion.state);
  scale(motion.duration, length_ - speed_);
  scale(motion.distance, length_);
  scale(motion.velocity_after, speed_);
  scale(motion.angular_velocity_after, speed_ - length_);
}

void SequenceUnits::to_si(Sequence& sequence) const {
  if (sequence.last_motion) to_si(*sequence.last_motion);
  for (StateAt& state : sequence.states) to_si(state);
  for (ImpactRow& row : sequence.rows) to_si(row);
  if (sequence.tail) to_si(*sequence.tail);
  for (SustainedContact& contact : sequence.contacts) to_si(contact);
  if (sequence.standing) {
    scale(sequence.standing->time, length_ - speed_);
    to_si(sequence.standing->state);
    to_si(sequence.standing->error);
  }
  scale(sequence.energy_at_end, mass_ + 2 * speed_);
  if (sequence.rest) scale(sequence.rest->latest, length_ - speed_);
  to_si(sequence.near_miss);
  scale(sequence.end_acceleration, 2 * speed_ - length_);
  scale(sequence.total_normal_impulse, mass_ + speed_);
  scale(sequence.first_flight_error, length_ - speed_);
}

void Drop::validate() const {
  body.validate();
  law.validate();
  require(std::isfinite(attitude.norm()) && attitude.norm() > 0, "length of the attitude's Euler parameters",
          attitude.norm(), "above 0 and finite");
  for (int i = 0; i < 3; ++i) {
    require(std::isfinite(velocity[i]), "velocity", velocity[i], "finite");
    require(std::isfinite(angular_velocity[i]), "angular velocity", angular_velocity[i], "finite");
  }
  require(gravity >= 0 && std::isfinite(gravity), "gravity", gravity, "at least 0 and finite");
  require(std::isfinite(gravity_along), "gravity along the ground", gravity_along, "finite");
  if (release_height) {
    require(std::isfinite(*release_height) && *release_height > touch_height(body, attitude.normalized()),
            "release height", *release_height, "finite and above that at which the body touches");
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

RowErrors RowErrors::unknown() {
  return {.predictable = false,
          .start = infinite,
          .attitude = infinite,
          .approach_speed = infinite,
          .impulse = infinite,
          .velocity_after = infinite,
          .angular_velocity_after = infinite,
          .energy_before = infinite,
          .energy_after = infinite};
}

}  // namespace clatter::analytic::space
