// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/impact_rows.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"

namespace clatter::analytic {

using detail::require;
using detail::Scales;
namespace of = detail::of;
namespace {

int exponent_of(double value) { return value == 0 ? 0 : std::ilogb(value); }

void apply(const Scales& scale, PlanarVelocity& v) {
  scale(of::speed, v.normal, v.tangential);
  scale(of::rate, v.angular);
}

void apply(const Scales& scale, NearMiss& miss) {
  scale(of::length, miss.clearance, miss.margin);
  scale(of::time, miss.time);
}

void apply(const Scales& scale, Impact& impact) {
  scale(of::impulse, impact.normal_impulse, impact.tangential_impulse);
  scale(of::speed, impact.approach_speed, impact.separation_speed, impact.slip_before, impact.slip_after);
  scale(of::energy, impact.energy_loss);
  apply(scale, impact.after);
}

void apply(const Scales& scale, RowErrors& error) {
  scale(of::time, error.start);
  scale(of::speed, error.approach_speed);
  scale(of::impulse, error.impulse, error.normal_impulse, error.tangential_impulse);
  scale(of::speed, error.velocity_after, error.normal_velocity_after, error.tangential_velocity_after);
  scale(of::rate, error.angular_velocity_after);
  scale(of::energy, error.energy_before, error.energy_after, error.energy_loss);
}

void apply(const Scales& scale, ImpactRow& row) {
  scale(of::time, row.start, row.flight.arrival.time, row.flight.arrival.bracket_low, row.flight.arrival.bracket_high);
  scale(of::length, row.centre_height);
  scale(of::energy, row.energy_before, row.energy_after);
  apply(scale, row.error);
  apply(scale, row.before);
  apply(scale, row.impact);
  apply(scale, row.flight.near_miss);
  scale(of::speed, row.departure.normal, row.departure.rebound_speed);
  scale(of::rate, row.departure.angular);
  scale(of::acceleration, row.departure.gravity, row.departure.gravity_along);
}

void apply(const Scales& scale, Tail& tail) {
  scale(of::time, tail.end_time, tail.end_time_error);
  scale(of::impulse, tail.normal_impulse, tail.normal_impulse_error, tail.tangential_impulse,
        tail.tangential_impulse_error);
  scale(of::speed, tail.velocity_after, tail.velocity_error, tail.normal_velocity_error,
        tail.tangential_velocity_error);
  scale(of::rate, tail.angular_velocity_after, tail.angular_velocity_error);
}

}  // namespace

Units::Units(const Drop& drop)
    : scales_{.length = exponent_of(drop.body.reach()),
              .speed = exponent_of(drop.velocity.normal),
              .mass = exponent_of(drop.body.mass)} {}

Drop Units::to_internal(Drop drop) const {
  const Scales scale = scales_.inverse();
  scale(of::mass, drop.body.mass);
  scale(of::area, drop.body.gyration_square);
  for (Vertex& vertex : drop.body.vertices) scale(of::length, vertex.x, vertex.z);
  apply(scale, drop.velocity);
  scale(of::acceleration, drop.gravity, drop.gravity_along);
  scale(of::slowness, drop.law.damping_per_stiffness);
  if (drop.fall) scale(of::speed, drop.fall->normal_error);
  return drop;
}

SequenceOptions Units::to_internal(SequenceOptions options) const {
  scales_.inverse()(of::time, options.until);
  return options;
}

double Units::energy(double internal) const {
  scales_(of::energy, internal);
  return internal;
}

void Units::to_si(Sequence& sequence) const {
  for (ImpactRow& row : sequence.rows) apply(scales_, row);
  scales_(of::impulse, sequence.total_normal_impulse, sequence.total_normal_impulse_error);
  apply(scales_, sequence.near_miss);
  if (sequence.slide) {
    scales_(of::time, sequence.slide->begin, sequence.slide->duration);
    scales_(of::speed, sequence.slide->speed);
    scales_(of::length, sequence.slide->distance);
  }
  if (sequence.tail) apply(scales_, *sequence.tail);
}

void Tail::set_after(const PlanarVelocity& after) {
  velocity_after = {after.tangential, 0, after.normal};
  angular_velocity_after = {0, after.angular, 0};
}

void Tail::set_errors(const PlanarVelocity& error) {
  normal_velocity_error = error.normal;
  tangential_velocity_error = error.tangential;
  velocity_error = std::hypot(error.normal, error.tangential);
  angular_velocity_error = error.angular;
}

void Drop::validate() const {
  law.validate();
  require(law.ratio_direction == Eigen::Vector2d::UnitX(), "impulse ratio's direction along x", law.ratio_direction.x(),
          "1 in the plane");
  // What was assigned member by member may be no angle: one of them alone would be taken.
  const auto is_near = [](double one, double other) {
    return std::fabs(one - other) <= 1e-15 * std::fmax(1, std::fabs(other));
  };
  if (!is_near(inclination.sine, std::sin(inclination.radians)) ||
      !is_near(inclination.cosine, std::cos(inclination.radians)) ||
      !is_near(inclination.degrees, inclination.radians * degrees_per_radian))
    throw std::domain_error(
        "inclination: its members are those of different angles; Angle::from_degrees and from_radians make one");
  require(std::fabs(inclination.radians) <= pi, "inclination", inclination.degrees, "from -180 to 180 degrees");
  require(gravity >= 0 && std::isfinite(gravity), "gravity", gravity, "at least 0 and finite");
  require(std::isfinite(gravity_along), "gravity along the ground", gravity_along, "finite");
  require(std::isfinite(velocity.normal), "normal velocity", velocity.normal, "finite");
  require(std::isfinite(velocity.tangential), "tangential velocity", velocity.tangential, "finite");
  require(std::isfinite(velocity.angular), "spin", velocity.angular, "finite");
  require(body.vertex_count >= 1 && body.vertex_count <= max_vertices, "vertex count", body.vertex_count,
          "from 1 to 4");
  require(body.mass > 0 && std::isfinite(body.mass), "mass", body.mass, "greater than 0 and finite");
  for (int i = 0; i < body.vertex_count; ++i) {
    const Vertex& vertex = body.vertices[static_cast<std::size_t>(i)];
    require(std::isfinite(vertex.x) && std::isfinite(vertex.z), "vertex", std::isfinite(vertex.x) ? vertex.z : vertex.x,
            "finite");
  }
  if (release_height) {
    require(std::isfinite(*release_height) && *release_height > touch_height(body, inclination), "release height",
            *release_height, "finite and above that at which the body touches");
    require(gravity_along == 0, "gravity along the ground", gravity_along, "0 with a release height");
  }
  // k² of lengths beyond 1e±150 m overflows or loses its digits.
  require(std::isnormal(body.gyration_square) && body.gyration_square > 0, "gyration radius squared",
          body.gyration_square, "a positive double that is not subnormal");
}

using detail::epsilon;
using detail::infinite;

double touch_height(const PlanarBody& body, const Angle& inclination) {
  double lowest = infinite;
  for (int i = 0; i < body.vertex_count; ++i)
    lowest = std::fmin(lowest, body.contact_point(i, inclination.sine, inclination.cosine).normal);
  return -lowest;
}

Drop after_free_fall(const Drop& release) {
  release.validate();
  const double height = release.release_height.value();
  const PlanarVelocity& v = release.velocity;
  const double sense = v.angular < 0 ? -1 : 1;
  std::array<VertexHeight, max_vertices> heights;
  int first = -1;
  FirstRoot touch;
  for (int i = 0; i < release.body.vertex_count; ++i) {
    const ContactPoint d = release.body.contact_point(i, release.inclination.sine, release.inclination.cosine);
    const auto k = static_cast<std::size_t>(i);
    heights[k] = {.height = height + d.normal,
                  .velocity = v.normal - v.angular * d.tangential,
                  .gravity = release.gravity,
                  .rate = std::fabs(v.angular),
                  .versine = -d.normal,
                  .sine = sense * d.tangential};
    const FirstRoot root = first_root(heights[k], touch.time.value_or(detail::never));
    if (root.time && (!touch.time || *root.time < *touch.time)) first = i, touch = root;
  }
  if (first < 0) throw std::domain_error("the released body never reaches the ground");
  const double t = *touch.time;
  // Rounding of the numbers given counts as much as that of the height, which is below 4ε × scale.
  const auto error_of = [&](const VertexHeight::Value& at) { return 8 * epsilon * (at.scale + height); };
  const auto at = [&](int i) { return heights[i].at(t); };
  const VertexHeight::Value arrival = at(first);
  double late = touch.within_margin ? infinite : error_of(arrival) / std::fabs(arrival.velocity);
  const double bend = std::fabs(heights[first].acceleration(t));
  if (!(late * bend <= 0.02 * std::fabs(arrival.velocity))) late = infinite;
  for (int i = 0; i < release.body.vertex_count && v.angular != 0; ++i) {  // which of them comes first must be certain
    const VertexHeight::Value other = at(i);
    if (i != first && other.velocity < 0 && !(other.height > 2 * error_of(other))) late = infinite;
  }
  Drop drop = release;
  drop.release_height.reset();
  if (v.angular != 0)
    drop.inclination = Angle::from_radians(std::remainder(release.inclination.radians - v.angular * t, 2 * pi));
  drop.velocity.normal -= release.gravity * t;
  drop.fall = {.time = t,
               .time_error = late,
               .inclination_error = v.angular == 0 ? 0
                                                   : std::fabs(v.angular) * (late + epsilon * t) +
                                                         epsilon * std::fabs(release.inclination.radians),
               .normal_error = release.gravity * (late + epsilon * t)};
  return drop;
}

}  // namespace clatter::analytic
