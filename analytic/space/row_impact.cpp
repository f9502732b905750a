// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/row_impact.hpp"

#include <cmath>

#include "analytic/detail/limits.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::missing;

namespace {

Impact impact_of(const GroupImpact& group, const State& before, const Vector3& place) {
  const Vector3 arm = before.attitude * place;
  return {.impulse = group.impulse,
          .contact_before = before.velocity + before.angular_velocity.cross(arm),
          .contact_after = group.velocity_after + group.angular_velocity_after.cross(arm),
          .velocity_after = group.velocity_after,
          .angular_velocity_after = group.angular_velocity_after,
          .compression_impulse = missing,
          .slip_stop_impulse = missing,
          .least_slip = missing,
          .energy_loss = group.energy_loss,
          .path = group.path};
}

}  // namespace

void strike_row(const Body& body, const Law& law, ImpactRow& row) {
  const Corner& corner = row.corners.front();
  if (row.corners.size() > 1 || corner.radius > 0) {
    row.group = strike_together(body, row.before, row.corners, law);
    row.impact = impact_of(*row.group, row.before, corner.place);
    row.approach_speed = row.group->approach_speed;
    return;
  }
  ContactVelocity velocity = contact_velocity(row.before, corner.place);
  // A small hop knows its normal velocity better.
  if (row.flight.time > 0 && row.flight.velocity_error < 2 * epsilon * velocity.scale) {
    velocity.value.z() = row.flight.normal_velocity;
  }
  row.impact = strike(body, row.before, velocity, corner.place, law);
  row.approach_speed = -velocity.value.z();
}

Impact struck_again(const Body& body, const Law& law, const ImpactRow& row, const State& before) {
  const Corner& corner = row.corners.front();
  if (row.group) return impact_of(strike_together(body, before, row.corners, law), before, corner.place);
  return strike(body, before, touching_place(body, before.attitude, corner.index), law);
}

void find_departures(const Law& law, const ImpactRow& row, const State& after, std::vector<Touch>& touches) {
  const bool plastic = law.law.restitution == 0 && law.law.law != RestitutionLaw::viscoelastic;
  touches.clear();
  for (const Corner& corner : row.corners) {
    const ContactVelocity velocity = contact_velocity(after, corner.place);
    const double turning = corner.radius * after.angular_velocity.head<2>().norm();  // of a level rim
    double normal = row.group ? velocity.value.z() - turning : row.impact.contact_after.z();
    const bool rounding = std::fabs(normal) <= 16 * epsilon * velocity.scale;
    if (rounding && (row.group || plastic)) normal = 0;
    touches.push_back({corner.index, normal});
  }
}

}  // namespace clatter::analytic::space
