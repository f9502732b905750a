// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/steady_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numeric/contact/equilibrium.hpp"

namespace clatter::numeric {
namespace {

/// Part of the speed and acceleration of a fall below which a body lies still.
constexpr double least_rest = 1e-6, largest_rest = 1e-5;
/// The same of a slide, of which what is left brings next to nothing: its friction counts vertical motion exactly.
constexpr double largest_left = 1e-3;
constexpr double slow_roll = 1e-2;  ///< of g: deceleration of a body that rolls on
constexpr double no_slip = 1e-3;    ///< of its speed: slip of a body that rolls
constexpr double roundness = 1e-9;  ///< of shape and inertia
/// A window of RockingWatch, in evaluations and in periods; growth between two that counts as none; how fast its
/// farthest point may turn, over a fall; how far a body that rocks in place may move, over its depth.
constexpr long window = 10'000;
constexpr double least_periods = 0.5;
constexpr double steady_growth = 1.05, fastest_rocking = 3, farthest_move = 10;

/// An instant on the ground, with what its motions are measured by.
struct Instant {
  const ContactSystem& system;
  const ContactInstant& at;
  double fall, part;  ///< speed of a fall as deep as the contact [m/s], and the part of it that is left of no account
  double sliding;     ///< [m/s]
  double turning, spin;  ///< speeds of the farthest point by all of the turning, and about the vertical [m/s]
  double rest;           ///< speed below which nothing moves [m/s]
  [[nodiscard]] const Ground& ground() const { return system.ground(); }
  [[nodiscard]] double radius() const { return system.body().radius(); }
  [[nodiscard]] bool is_level() const { return system.gravity_along() == 0; }
};

std::optional<Instant> instant_of(const ContactSystem& system, const ContactInstant& at, double kept_up) {
  const double g = system.gravity(), depth = at.diagnosis.load.deepest, fall = std::sqrt(g * depth);
  if (!(g > 0) || !(depth > 0)) return std::nullopt;
  const double part = std::clamp(kept_up / fall, least_rest, largest_rest);
  return Instant{.system = system,
                 .at = at,
                 .fall = fall,
                 .part = part,
                 .sliding = std::hypot(velocity(at.state).x(), velocity(at.state).y()),
                 .turning = system.body().radius() * angular_velocity(at.state).norm(),
                 .spin = system.body().radius() * std::fabs(at.diagnosis.spin),
                 .rest = least_rest * fall};
}

/// Whether the body slides down a slope that friction cannot hold it on, ever faster.
bool slides_down(const Instant& now) {
  const double along = now.system.gravity_along();
  return std::fabs(along) > now.ground().sliding_friction * now.system.gravity() &&
         velocity(now.at.state).x() * along > 0;
}

/// Acceleration of a body that slides down the slope, straight down it.
Vector3 downhill_acceleration(const Instant& now) {
  const double along = now.system.gravity_along();
  return {along - std::copysign(now.ground().sliding_friction * now.system.gravity(), along), 0, 0};
}

/// The acceleration of friction and gravity on a body that slides along a straight line.
Vector3 sliding_acceleration(const Instant& now) {
  const Vector3 direction = Vector3(velocity(now.at.state).x(), velocity(now.at.state).y(), 0) / now.sliding;
  return Vector3(now.system.gravity_along(), 0, 0) - now.ground().sliding_friction * now.system.gravity() * direction;
}

/// Whether only sliding and spinning are left, with this acceleration.
bool is_steady(const Instant& now, const Vector3& acceleration, double part) {
  const double tipping = std::sqrt(std::max(now.turning * now.turning - now.spin * now.spin, 0.0)),
               g = now.system.gravity();
  return std::fabs(velocity(now.at.state).z()) <= part * now.fall && tipping <= part * now.fall + 1e-7 * now.turning &&
         (velocity(now.at.rate) - acceleration).norm() <= part * g &&
         now.radius() * angular_velocity(now.at.rate).norm() <= part * g;
}

/// Whether friction acts on a body that slides on a straight line, along x on a slope, so that it stops there.
bool slides_to_rest(const Instant& now) {
  const Ground& ground = now.ground();
  const double g = now.system.gravity(), along = now.system.gravity_along();
  if (!(now.sliding > now.rest) || !(now.spin <= now.rest) || ground.friction == FrictionLaw::regularised) return false;
  if (now.system.phase().kind == FrictionPhase::Kind::stick || !(ground.sliding_friction > 0)) return false;
  if (now.is_level()) return true;
  return std::fabs(velocity(now.at.state).y()) <= now.rest && ground.sliding_friction * g > std::fabs(along);
}

/// Whether sliding and spinning go on for ever: without friction, down a slope, or about the pressure centre of a patch
/// that counts as a point.
bool goes_on_for_ever(const Instant& now) {
  return slides_down(now) || now.ground().sliding_friction == 0 ||
         (now.system.phase().kind == FrictionPhase::Kind::stick && now.system.phase().point);
}

/// Whether the body looks the same however far it has turned about its axis.
bool is_round_about_axis(const Instant& now) {
  const Body& body = now.system.body();
  if (!body.smooth()) return false;
  const SmoothShape& shape = *body.smooth();
  const Vector3 omega = angular_velocity(now.at.state), momentum = body.inertia() * omega;
  if (!(omega.cross(momentum).norm() <= roundness * omega.norm() * momentum.norm())) return false;
  if (shape.ends() == 1 && shape.is_ball() && shape.centre.norm() <= roundness * now.radius()) return true;
  const bool about_x = now.radius() * std::hypot(omega.y(), omega.z()) <= now.part * now.fall + 1e-7 * now.turning;
  return about_x && std::hypot(shape.centre.y(), shape.centre.z()) <= roundness * now.radius() &&
         shape.semiaxes.y() == shape.semiaxes.z();
}

/// λ of a motion that dies away as V̇ = −λV, from 0 on; nothing where it changes otherwise or faster.
std::optional<double> decay_of(const Vector3& motion, const Vector3& rate, double size, double g, double part) {
  const double square = motion.squaredNorm();
  const double decay = square > 0 ? std::max(-motion.dot(rate) / square, 0.0) : 0;
  if (!(size * (rate + decay * motion).norm() <= part * g) || !(decay * size * std::sqrt(square) <= slow_roll * g))
    return std::nullopt;
  return size * decay * std::sqrt(square) > part * g ? decay : 0;
}

Gravity pull_of(const ContactSystem& system) { return {system.gravity(), system.gravity_along()}; }
Vector3 gravity_of(const ContactSystem& system) { return pull_of(system).acceleration(); }

/// The equilibrium of the body near a state.
std::optional<Equilibrium> level_near(const ContactSystem& system, const MotionState& pose) {
  return equilibrium_near(system.body(), system.ground(), pull_of(system), system.planar(), pose);
}

/// The motion from now on, of which `turning` is left.
GroundMotion motion_from(const Instant& now, GroundMotionKind kind, const Vector3& turning) {
  GroundMotion motion;
  motion.kind = kind;
  motion.from = now.system.motion(now.at.state);
  const Vector3 velocity = motion.from.velocity;
  motion.from.velocity.z() = 0;
  motion.left_turning = (motion.from.angular_velocity - turning).norm();
  motion.from.angular_velocity = turning;
  motion.left_speed = std::fabs(velocity.z());
  motion.left_time = std::sqrt(now.at.diagnosis.load.deepest / now.system.gravity());
  motion.energy_stored = now.at.diagnosis.load.energy;
  motion.rest_force = -now.system.body().mass() * gravity_of(now.system);
  return motion;
}

Vector3 vertical_turning(const Instant& now) {
  const MotionState motion = now.system.motion(now.at.state);
  return motion.attitude.conjugate() * Vector3(0, 0, now.at.diagnosis.spin);
}

GroundMotion rest_of(const Instant& now) {
  GroundMotion motion = motion_from(now, GroundMotionKind::rests, Vector3::Zero());
  motion.left_speed = std::hypot(motion.left_speed, now.sliding);
  motion.from.velocity.setZero();
  motion.stops_after = 0;
  motion.rest = {motion.from, now.at.diagnosis.load.deepest, motion.energy_stored};
  return motion;
}

/// The impulse of the normal force until the body lies still is m g t − m v_z, and friction's μ times that.  Where the
/// body stops it turns into its equilibrium about the pressure centre, which sticks.
GroundMotion slide_of(const Instant& now) {
  GroundMotion motion = motion_from(now, GroundMotionKind::rests, Vector3::Zero());
  motion.acceleration = sliding_acceleration(now);
  motion.force = now.system.body().mass() * (motion.acceleration - gravity_of(now.system));
  Vector3& v = motion.from.velocity;
  v += now.ground().sliding_friction * velocity(now.at.state).z() * v.normalized();
  motion.stops_after = v.squaredNorm() / -motion.acceleration.dot(v);
  MotionState end = motion.from;
  end.centre += v * (motion.stops_after / 2);
  end.velocity.setZero();
  motion.rest = {end, now.at.diagnosis.load.deepest, motion.energy_stored};
  const auto level = level_near(now.system, end);
  if (!level) return motion;
  motion.rest = *level;
  const Vector3 change = end.attitude * now.at.diagnosis.centre - level->state.attitude * now.at.diagnosis.centre;
  motion.rest.state.centre.x() += change.x();
  motion.rest.state.centre.y() += change.y();
  return motion;
}

/// The equilibrium about which the body rocks, its pressure centre where it is.
std::optional<GroundMotion> rocking_rest_of(const Instant& now) {
  GroundMotion motion = rest_of(now);
  const auto level = level_near(now.system, motion.from);
  if (!level) return std::nullopt;
  motion.rest = *level;
  return motion;
}

/// Sliding and spinning on.
GroundMotion glide_of(const Instant& now) {
  const auto kind = now.sliding > now.rest ? GroundMotionKind::slides : GroundMotionKind::spins;
  GroundMotion motion = motion_from(now, kind, vertical_turning(now));
  if (slides_down(now)) motion.acceleration = downhill_acceleration(now);
  motion.force = now.system.body().mass() * (motion.acceleration - gravity_of(now.system));
  return motion;
}

/// Rolling on, or turning about a horizontal axis without friction.
std::optional<GroundMotion> roll_of(const Instant& now) {
  if (!now.is_level() || !is_round_about_axis(now)) return std::nullopt;
  const bool has_friction = now.ground().has_friction();
  const double slip = now.at.diagnosis.slip.norm();
  if (!(std::fabs(velocity(now.at.state).z()) <= now.part * now.fall)) return std::nullopt;
  if (has_friction && !(now.sliding > now.rest && slip <= no_slip * now.sliding)) return std::nullopt;
  if (has_friction && !(now.spin <= now.rest) && !now.system.phase().point) return std::nullopt;
  const double g = now.system.gravity();
  Vector3 velocity_now = velocity(now.at.state);
  velocity_now.z() = 0;
  const Vector3 omega = angular_velocity(now.at.state);
  const auto decay = decay_of(velocity_now, velocity(now.at.rate), 1, g, now.part);
  const auto turning = decay_of(omega, angular_velocity(now.at.rate), now.radius(), g, now.part);
  if (!decay || !turning) return std::nullopt;
  const bool moves = now.sliding > now.rest;
  GroundMotion motion = motion_from(now,
                                    has_friction ? GroundMotionKind::rolls
                                    : moves      ? GroundMotionKind::slides
                                                 : GroundMotionKind::spins,
                                    omega);
  motion.decay = *decay;
  motion.turning_decay = *turning;
  motion.force = now.system.body().mass() * (-*decay * velocity_now - gravity_of(now.system));
  return motion;
}

}  // namespace

std::optional<GroundMotion> motion_on_the_ground(const ContactSystem& system, const ContactInstant& at,
                                                 double kept_up) {
  const auto now = instant_of(system, at, kept_up);
  if (!now || !(std::fabs(velocity(at.state).z()) <= std::max(now->part, largest_left) * now->fall))
    return std::nullopt;
  const bool moves = now->sliding > now->rest || now->spin > now->rest;
  if (is_steady(*now, moves && slides_down(*now) ? downhill_acceleration(*now) : Vector3::Zero(), now->part)) {
    if (!moves) return rest_of(*now);
    if (goes_on_for_ever(*now)) return glide_of(*now);
  }
  if (slides_to_rest(*now) && is_steady(*now, sliding_acceleration(*now), largest_left)) return slide_of(*now);
  return roll_of(*now);
}

void RockingWatch::begin(long evaluations) {
  now_ = {};
  before_.reset();
  ends_ = evaluations + window;
}

std::optional<GroundMotion> RockingWatch::look(const ContactSystem& system, const ContactInstant& at) {
  const Vector3 v = velocity(at.state);
  if (!now_.begin) now_.begin = at.time;
  now_.heave = std::max(now_.heave, std::fabs(v.z()));
  now_.sliding = std::max(now_.sliding, std::hypot(v.x(), v.y()));
  now_.turning = std::max(now_.turning, angular_velocity(at.state).norm());
  now_.spin = std::max(now_.spin, std::fabs(at.diagnosis.spin));
  now_.depth = std::max(now_.depth, at.diagnosis.load.deepest);
  now_.slips = now_.slips && system.phase().kind != FrictionPhase::Kind::stick;
  const double period = 2 * std::numbers::pi * std::sqrt(now_.depth / system.gravity());
  if (system.evaluations() < ends_ || !(at.time - *now_.begin >= least_periods * period)) return std::nullopt;
  now_.place = system.motion(at.state).centre;
  const auto found = judge(system, at);
  before_ = now_;
  now_ = {};
  ends_ = system.evaluations() + window;
  return found;
}

std::optional<GroundMotion> RockingWatch::judge(const ContactSystem& system, const ContactInstant& at) const {
  if (!before_) return std::nullopt;
  const double fall = std::sqrt(system.gravity() * now_.depth), radius = system.body().radius();
  const bool is_small = now_.heave <= fall && radius * now_.turning <= fastest_rocking * fall;
  const bool is_steady =
      now_.heave <= steady_growth * before_->heave && now_.turning <= steady_growth * before_->turning;
  const auto now = instant_of(system, at, 0);
  if (!is_small || !is_steady || !now) return std::nullopt;
  const double moved = (now_.place - before_->place).head<2>().norm();
  const bool stays = now_.sliding <= fall && moved <= farthest_move * now_.depth &&
                     (system.ground().has_friction() || std::max(radius * now_.spin, now_.sliding) <= now->rest);
  std::optional<GroundMotion> motion;
  if (stays) motion = rocking_rest_of(*now);
  else if (now_.slips && before_->slips && radius * now_.spin <= now->rest && slides_to_rest(*now))
    motion = slide_of(*now);
  if (!motion) return std::nullopt;
  motion->left_speed = std::hypot(now_.heave, stays ? now_.sliding : radius * now_.turning);
  motion->left_turning = now_.turning;
  motion->rocks = true;
  return motion;
}

}  // namespace clatter::numeric
