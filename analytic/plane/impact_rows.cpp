// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/impact_rows.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "analytic/base/errors.hpp"

namespace clatter::analytic {

namespace {

/// std::ldexp, by a product where the factor is a normal double: rounded once, as by std::ldexp.
void scale(double& value, int exponent) {
  if (std::abs(exponent) > 1022) {
    value = std::ldexp(value, exponent);
    return;
  }
  constexpr int bias = 1023, fraction_bits = 52;
  value *= std::bit_cast<double>(static_cast<std::uint64_t>(exponent + bias) << fraction_bits);
}

int exponent_of(double value) { return value == 0 ? 0 : std::ilogb(value); }

}  // namespace

Units::Units(const Drop& drop)
    : length_(exponent_of(drop.body.reach())), speed_(exponent_of(drop.velocity.normal)),
      mass_(exponent_of(drop.body.mass)) {}

Drop Units::to_internal(Drop drop) const {
  scale(drop.body.mass, -mass_);
  scale(drop.body.gyration_square, -2 * length_);
  for (Vertex& vertex : drop.body.vertices) {
    scale(vertex.x, -length_);
    scale(vertex.z, -length_);
  }
  scale(drop.velocity.normal, -speed_);
  scale(drop.velocity.tangential, -speed_);
  scale(drop.velocity.angular, length_ - speed_);
  scale(drop.gravity, length_ - 2 * speed_);
  scale(drop.gravity_along, length_ - 2 * speed_);
  scale(drop.law.damping_per_stiffness, speed_);
  if (drop.fall) scale(drop.fall->normal_error, -speed_);
  return drop;
}

SequenceOptions Units::to_internal(const SequenceOptions& options) const {
  SequenceOptions o = options;
  scale(o.until, speed_ - length_);
  return o;
}

double Units::energy(double internal) const { return std::ldexp(internal, mass_ + 2 * speed_); }

void Units::to_si(PlanarVelocity& v) const {
  scale(v.normal, speed_);
  scale(v.tangential, speed_);
  scale(v.angular, speed_ - length_);
}

void Units::to_si(Impact& impact) const {
  scale(impact.normal_impulse, mass_ + speed_);
  scale(impact.tangential_impulse, mass_ + speed_);
  scale(impact.approach_speed, speed_);
  scale(impact.separation_speed, speed_);
  scale(impact.slip_before, speed_);
  scale(impact.slip_after, speed_);
  scale(impact.energy_loss, mass_ + 2 * speed_);
  to_si(impact.after);
}

void Units::to_si(RowErrors& error) const {
  scale(error.start, length_ - speed_);
  scale(error.approach_speed, speed_);
  scale(error.normal_impulse, mass_ + speed_);
  scale(error.tangential_impulse, mass_ + speed_);
  to_si(error.after);
  scale(error.energy_before, mass_ + 2 * speed_);
  scale(error.energy_after, mass_ + 2 * speed_);
  scale(error.energy_loss, mass_ + 2 * speed_);
}

void Units::to_si(NearMiss& miss) const {
  scale(miss.clearance, length_);
  scale(miss.margin, length_);
  scale(miss.time, length_ - speed_);
}

void Units::to_si(ImpactRow& row) const {
  const int time = length_ - speed_;
  scale(row.start, time);
  scale(row.centre_height, length_);
  scale(row.energy_before, mass_ + 2 * speed_);
  scale(row.energy_after, mass_ + 2 * speed_);
  to_si(row.error);
  to_si(row.before);
  to_si(row.impact);
  scale(row.flight.arrival.time, time);
  scale(row.flight.arrival.bracket_low, time);
  scale(row.flight.arrival.bracket_high, time);
  to_si(row.flight.near_miss);
  scale(row.departure.normal, speed_);
  scale(row.departure.angular, -time);
  scale(row.departure.gravity, 2 * speed_ - length_);
  scale(row.departure.gravity_along, 2 * speed_ - length_);
  scale(row.departure.rebound_speed, speed_);
}

void Units::to_si(Sequence& sequence) const {
  for (ImpactRow& row : sequence.rows) to_si(row);
  scale(sequence.total_normal_impulse, mass_ + speed_);
  scale(sequence.total_normal_impulse_error, mass_ + speed_);
  to_si(sequence.near_miss);
  if (sequence.slide) {
    scale(sequence.slide->begin, length_ - speed_);
    scale(sequence.slide->speed, speed_);
    scale(sequence.slide->duration, length_ - speed_);
    scale(sequence.slide->distance, length_);
  }
  if (!sequence.tail) return;
  Tail& tail = *sequence.tail;
  scale(tail.end_time, length_ - speed_);
  scale(tail.end_time_error, length_ - speed_);
  scale(tail.normal_impulse, mass_ + speed_);
  scale(tail.normal_impulse_error, mass_ + speed_);
  scale(tail.tangential_impulse, mass_ + speed_);
  scale(tail.tangential_impulse_error, mass_ + speed_);
  to_si(tail.after_error);
  to_si(tail.after);
}

using detail::require;

void Drop::validate() const {
  law.validate();
  require(std::fabs(inclination.radians) <= pi, "inclination", inclination.degrees, "from -180 to 180 degrees");
  require(gravity >= 0 && std::isfinite(gravity), "gravity", gravity, "at least 0 and finite");
  require(std::isfinite(gravity_along), "gravity along the ground", gravity_along, "finite");
  require(std::isfinite(velocity.normal), "normal velocity", velocity.normal, "finite");
  require(std::isfinite(velocity.tangential), "tangential velocity", velocity.tangential, "finite");
  require(std::isfinite(velocity.angular), "spin", velocity.angular, "finite");
  require(body.vertex_count >= 1, "vertex count", body.vertex_count, "at least 1");
  // k² of lengths beyond 1e±150 m overflows or loses its digits.
  require(std::isnormal(body.gyration_square) && body.gyration_square > 0, "gyration radius squared",
          body.gyration_square, "a positive double that is not subnormal");
}

RowErrors RowErrors::unknown() {
  constexpr double none = std::numeric_limits<double>::infinity();
  return {.predictable = false,
          .relative = none,
          .start = none,
          .inclination = none,
          .contact_angle = none,
          .approach_speed = none,
          .restitution = none,
          .normal_impulse = none,
          .tangential_impulse = none,
          .impulse_ratio = none,
          .after = {.normal = none, .tangential = none, .angular = none},
          .energy_before = none,
          .energy_after = none,
          .energy_loss = none};
}

}  // namespace clatter::analytic
