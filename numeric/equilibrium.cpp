// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/equilibrium.hpp"

#include <cmath>

#include "numeric/base/errors.hpp"
#include "numeric/contact/equilibrium.hpp"

namespace clatter::numeric {

Equilibrium equilibrium(const Body& body, const World& world, const MotionState& near) {
  world.validate();
  const Gravity gravity = world.gravity_in_contact ? world.pull() : Gravity(0);
  if (const auto found = equilibrium_near(body, world.ground, gravity, world.planar, near)) return *found;
  throw NumericalError("the ground does not carry the body at rest near this attitude");
}

/// The pull along x stands for friction, which acts at the pressure centre against the slide: x is turned there.
Equilibrium sliding_equilibrium(const Body& body, const World& world, const MotionState& near) {
  const Ground& ground = world.ground;
  const double speed = std::hypot(near.velocity.x(), near.velocity.y());
  if (speed > 0 && ground.has_friction() && ground.friction != FrictionLaw::regularised && world.gravity_in_contact) {
    const Eigen::Quaterniond ahead(
        Eigen::AngleAxisd(std::atan2(near.velocity.y(), near.velocity.x()), Vector3::UnitZ()));
    MotionState turned = near;
    turned.attitude = ahead.conjugate() * near.attitude;
    Ground holding = ground;
    holding.static_friction = std::fmax(ground.static_friction, 2 * ground.sliding_friction);
    const double down = world.pull().down;
    auto found = equilibrium_near(body, holding, {down, ground.sliding_friction * down}, world.planar, turned);
    if (found) {
      found->state.attitude = ahead * found->state.attitude;
      found->state.centre.head<2>() = near.centre.head<2>();
      return *found;
    }
  }
  return equilibrium(body, world, near);
}

}  // namespace clatter::numeric
