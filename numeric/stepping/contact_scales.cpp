// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/contact_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::numeric {
namespace {

/// Mass that the touching point seems to have for a vertical push.
double effective_mass(const Body& body, const MotionState& touch, const Vector3& point) {
  const Vector3 arm = point.cross(touch.attitude.conjugate() * Vector3::UnitZ());
  return 1 / (1 / body.mass() + arm.dot(body.inverse_inertia() * arm));
}

}  // namespace

ContactScales contact_scales(ContactSystem& system, const MotionState& touch, const Vector3& point) {
  const Body& body = system.body();
  const Ground& ground = system.ground();
  const double g = system.gravity();
  const double fall = -(touch.velocity + touch.attitude * touch.angular_velocity.cross(point)).z();
  const double speed = std::max(fall, 0.0);
  const double kinetic = 0.5 * effective_mass(body, touch, point) * speed * speed;
  const double stiffening = 1 + ground.damping * speed / ground.stiffness;
  const auto takes_it_up = [&](double depth) {
    return stiffening * system.pressed(depth).energy >= kinetic + body.mass() * g * depth;
  };
  double high = 1e-4 * body.radius();
  while (!takes_it_up(high) && high < 1e150 * body.radius()) high *= 4;
  double low = high / 4;
  while (takes_it_up(low) && low > 1e-17 * body.radius()) low /= 4;
  high = 4 * low;
  for (int i = 0; i < 3; ++i) {
    const double middle = std::sqrt(low * high);
    (takes_it_up(middle) ? high : low) = middle;
  }
  ContactScales scales;
  scales.depth = high;
  scales.speed = std::sqrt(speed * speed + 2 * g * high);
  scales.time = scales.speed > 0 ? 3 * high / scales.speed : std::numeric_limits<double>::infinity();
  scales.energy = kinetic + body.mass() * g * high;
  return scales;
}

}  // namespace clatter::numeric
