#include "validation/compare/quantities.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::validation {

using analytic::degrees_per_radian;

Quantities quantities(const analytic::ImpactRow& row) {
  return {row.start,
          row.contact_angle * degrees_per_radian,
          row.impact.normal_impulse,
          row.impact.tangential_impulse,
          row.impact.after.normal,
          row.impact.after.tangential,
          row.impact.after.angular};
}

Quantities quantities(const analytic::RowErrors& errors) {
  return {errors.start,          errors.contact_angle * degrees_per_radian,
          errors.normal_impulse, errors.tangential_impulse,
          errors.after.normal,   errors.after.tangential,
          errors.after.angular};
}

Quantities quantities(const numeric::ImpactNumbers& n) {
  return {n.start,
          n.contact_angle * degrees_per_radian,
          n.impulse.z(),
          n.impulse.x(),
          n.velocity_after.z(),
          n.velocity_after.x(),
          n.angular_velocity_after.y()};
}

Quantities quantity_scales(const analytic::Sequence& sequence, const analytic::PlanarBody& body) {
  double speed = 0, time = 0;
  for (const analytic::ImpactRow& row : sequence.rows) {
    for (const analytic::PlanarVelocity& v : {row.before, row.impact.after}) {
      speed = std::max({speed, std::fabs(v.normal), std::fabs(v.tangential), std::fabs(v.angular) * body.reach()});
    }
    time = std::max(time, row.start);
  }
  if (time == 0) time = body.reach() / speed;
  return {time, degrees_per_radian, body.mass * speed, body.mass * speed, speed, speed, speed / body.reach()};
}

}  // namespace clatter::validation
