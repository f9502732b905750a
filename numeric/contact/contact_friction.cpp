// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of a contact: Eq. 5 (stick) and Eq. 6 (slip) at the pressure centre, or over the patch.
#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/contact/contact_instant.hpp"

namespace clatter::numeric {
namespace {

/// Slip with the phase's direction where it is too slow to have one; beyond the instant where slip ends, where
/// the step is only a trial, the old direction alone, which keeps it smooth.
AlongGround leaning_slip(const AlongGround& slip, const FrictionPhase& phase) {
  const AlongGround lean = phase.direction * std::max(phase.slow, std::numeric_limits<double>::min());
  if (!(slip.dot(phase.direction) > 0)) return lean;
  return {slip.east + lean.east, slip.north + lean.north};
}

AlongGround bounded(const AlongGround& force, double limit) {
  const double size = force.norm();
  if (size <= limit) return force;
  return std::isfinite(size) ? force * (limit / size) : AlongGround{};
}

/// Root x of D x = b for D = (by_east, by_north); 0 if D is singular.
AlongGround solve(const AlongGround& by_east, const AlongGround& by_north, const AlongGround& b) {
  const double size = std::max(by_east.norm(), by_north.norm());
  const AlongGround p = by_east * (1 / size), q = by_north * (1 / size);
  const double determinant = p.east * q.north - q.east * p.north;
  if (!(std::fabs(determinant) > 0)) return {};
  return AlongGround{b.east * q.north - b.north * q.east, b.north * p.east - b.east * p.north} *
         (1 / (size * determinant));
}

AlongGround unit_slip(const AlongGround& slip, const FrictionPhase& phase, bool planar) {
  if (planar) return phase.direction;
  const AlongGround leaning = leaning_slip(slip, phase);
  return leaning * (1 / leaning.norm());
}

}  // namespace

ContactSystem::Friction ContactSystem::friction(const Instant& at) {
  using Kind = FrictionPhase::Kind;
  const double mu = ground_.sliding_friction;
  switch (phase_.kind) {
    case Kind::none: return {};
    case Kind::regularised:
    case Kind::local: return over_patch(at, at.load);
    case Kind::stick: return in_stick(at);
    case Kind::slip: break;
  }
  if (!phase_.varies) return at_centre(at, unit_slip(at.slip, phase_, planar_) * (-mu * at.load.force));
  SlipField field{
      .kind = SlipField::Kind::turning, .centre = at.centre, .spin = at.normal.dot(at.view.angular_velocity)};
  const AlongGround slip = leaning_slip(at.slip, phase_);
  field.east = slip.east;
  field.north = slip.north;
  return over_patch(at, loader_.load(at.view, field));
}

ContactSystem::Friction ContactSystem::at_centre(const Instant& at, const AlongGround& force) const {
  return {force, at.centre.cross(along(at.view, force)), -force.dot(at.slip), {}};
}

/// A point at rest takes no work: where a remaining slip would give some back, none is booked.
ContactSystem::Friction ContactSystem::in_stick(const Instant& at) const {
  const AlongGround hold = stick(at);
  const double bound = stick_coefficient() * at.load.force;
  Friction friction = at_centre(at, bounded(hold, bound));
  friction.power = std::max(friction.power, 0.0);
  friction.hold = bounded(hold, 2 * bound);
  return friction;
}

/// Of a patch taken as flat only the resultant at the pressure centre and the moment about the vertical are real; so
/// their power, −∫f·v over the flat patch, is never negative.
ContactSystem::Friction ContactSystem::over_patch(const Instant& at, const ContactLoad& load) const {
  const double mu = ground_.sliding_friction;
  const AlongGround force{mu * load.slip_east, planar_ ? 0 : mu * load.slip_north};
  Friction friction{force, mu * load.slip_moment, 0, {}};
  if (phase_.kind == FrictionPhase::Kind::slip) {
    const Vector3 at_centre = at.centre.cross(along(at.view, force));
    friction.moment = at_centre + at.normal * at.normal.dot(friction.moment - at_centre);
  }
  friction.power =
      -friction.force.dot({at.view.east_speed, at.view.north_speed}) - friction.moment.dot(at.view.angular_velocity);
  return friction;
}

/// F_n times the condition of stick is linear in F_t:
///     F_n [F_t/m + α(F_t) × c]_t + [ω × F_n ċ(F_t)]_t = −F_n [α₀ × c + ω × (ω × c) + fading v]_t − [ω × F_n ċ₀]_t,
/// α₀ and ċ₀ being those without friction.  Both sides vanish with F_n, so that neither is divided by F_n.
AlongGround ContactSystem::stick(const Instant& at) const {
  const GroundView& view = at.view;
  const Vector3& omega = view.angular_velocity;
  const double normal = at.load.force;
  const auto along_ground = [&](const Vector3& point, const AlongGround& rest) {
    return AlongGround{view.east.dot(point) + normal * rest.east, view.north.dot(point) + normal * rest.north};
  };
  const auto per_force = [&](const AlongGround& unit) {
    const Vector3 alpha = response(at.centre.cross(along(view, unit)));
    const Vector3 wander = at.wander(at.response(ground_, alpha));
    return along_ground(normal * alpha.cross(at.centre) + omega.cross(wander), unit * (1 / body_.mass()));
  };
  const Vector3 alpha = angular_acceleration(at.moment, omega);
  const Vector3 wander = at.wander(at.changes(ground_, alpha));
  const Vector3 turning = alpha.cross(at.centre) + omega.cross(omega.cross(at.centre));
  const AlongGround free = along_ground(normal * turning + omega.cross(wander), at.slip * phase_.fading);
  const AlongGround by_east = per_force({1, 0});
  if (planar_) return by_east.east != 0 ? AlongGround{-free.east / by_east.east, 0} : AlongGround{};
  return solve(by_east, per_force({0, 1}), free * -1);
}

}  // namespace clatter::numeric
