// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/row_impact.hpp"

#include <cmath>
#include <span>

#include "analytic/base/limits.hpp"
#include "analytic/space/flight/point_height.hpp"
#include "analytic/space/landing/level_rim.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::missing;

namespace {

Impact impact_of(const GroupImpact& group, const State& before, const Vector3& place) {
  const Vector3 arm = before.attitude * place;
  return {.impulse = group.impulse,
          .contact_before = velocity_at(before, place),
          .contact_after = group.velocity_after + group.angular_velocity_after.cross(arm),
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
    row.approach_speed = row.group->approach_speed;
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
  row.approach_speed = -velocity.value.z();
}

Impact struck_again(const Body& body, const ImpactLaw& law, const ImpactRow& row, const State& before) {
  const Corner& corner = row.corners.front();
  if (row.group) return impact_of(group_impact(body, before, row, law), before, corner.place);
  const State state = aligned(body, before);
  return strike(body, state, touching_place(body, state.attitude, corner.index), law);
}

}  // namespace clatter::analytic::space
