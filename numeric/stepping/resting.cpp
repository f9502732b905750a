// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/resting.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::numeric {
namespace {

/// Part of the speed and acceleration of a fall below which a body lies still, and how many times the tolerance the
/// errors of steps keep up, so that a rough run ends too.
constexpr double least_rest = 1e-6, largest_rest = 1e-5, noise_per_tolerance = 300;

bool is_steady(const ContactSystem& system, const ContactInstant& at, double kept_up) {
  const double g = system.gravity();
  const double depth = at.diagnosis.load.deepest;
  if (!(g > 0) || !(depth > 0)) return false;
  const double radius = system.body().radius(), fall = std::sqrt(g * depth);
  const double part = std::clamp(kept_up / fall, least_rest, largest_rest);
  const double turning = angular_velocity(at.state).norm(), spin = at.diagnosis.spin;
  const double tipping = std::sqrt(std::max(turning * turning - spin * spin, 0.0));
  return std::fabs(velocity(at.state).z()) <= part * fall &&
         radius * tipping <= part * fall + 1e-7 * radius * turning && velocity(at.rate).norm() <= part * g &&
         radius * angular_velocity(at.rate).norm() <= part * g;
}

/// Sliding without friction, or spinning about a pressure centre that sticks, which this law does not resist.
bool goes_on_for_ever(const ContactSystem& system) {
  return system.ground().sliding_friction == 0 || system.phase().kind == FrictionPhase::Kind::stick;
}

}  // namespace

double kept_up_speed(double tolerance, double speed) { return noise_per_tolerance * tolerance * speed; }

std::optional<ContactEnding> ending_on_the_ground(const ContactSystem& system, const ContactInstant& at,
                                                  double kept_up) {
  if (!is_steady(system, at, kept_up)) return std::nullopt;
  const double speed = least_rest * std::sqrt(system.gravity() * at.diagnosis.load.deepest);
  const double sliding = std::hypot(velocity(at.state).x(), velocity(at.state).y());
  const double turning = system.body().radius() * std::fabs(at.diagnosis.spin);
  if (sliding <= speed && turning <= speed) return ContactEnding::at_rest;
  if (goes_on_for_ever(system)) return ContactEnding::sustained_contact;
  return std::nullopt;
}

}  // namespace clatter::numeric
