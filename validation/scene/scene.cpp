// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/scene.hpp"

#include <cmath>

namespace clatter::validation {

analytic::RestitutionLaw restitution_law(const Scene& scene) {
  if (scene.impact.law) return *scene.impact.law;
  return scene.impact.restitution || !scene.has_ground() ? analytic::RestitutionLaw::newton
                                                         : analytic::RestitutionLaw::viscoelastic;
}

bool takes_friction_of_ground(const Scene& scene) {
  const DiscreteImpact& impact = scene.impact;
  return !impact.impulse_ratio && !impact.friction && scene.has_ground() && scene.world.ground.has_friction();
}

Scene Scene::at(double value) const {
  Scene one = *this;
  if (sweep->quantity == SceneSweep::Quantity::angle_deg) one.angle_deg = value;
  else one.world.ground.static_friction = one.world.ground.sliding_friction = value;
  one.sweep.reset();
  one.settle_restitution();
  return one;
}

int Scene::most_impacts() const { return until_rest || std::isfinite(request.until) ? 100'000 : request.impacts; }

bool Scene::has_vectors() const { return !attitude.empty() || !velocity.empty() || !angular_velocity.empty(); }

}  // namespace clatter::validation
