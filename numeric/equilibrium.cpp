// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/equilibrium.hpp"

#include "numeric/base/errors.hpp"
#include "numeric/contact/equilibrium.hpp"

namespace clatter::numeric {

Equilibrium equilibrium(const Body& body, const World& world, const MotionState& near) {
  world.validate();
  const Gravity gravity = world.gravity_in_contact ? world.pull() : Gravity(0);
  if (const auto found = equilibrium_near(body, world.ground, gravity, world.planar, near)) return *found;
  throw NumericalError("the ground does not carry the body at rest near this attitude");
}

}  // namespace clatter::numeric
