// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/drop/error_growth.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/motion/equations_of_motion.hpp"
#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {
namespace {

constexpr double radians_per_step = 0.1;
constexpr double most_steps = 100'000;
/// The deviation with which a neighbour starts a contact: this part of its depth over the body's radius.
constexpr double part_of_depth = 1e-3, least_size = 1e-9, largest_size = 1e-5;
constexpr double tolerance_per_size = 0.02;  ///< of the neighbour's steps: errors of some per cent of the deviation

/// Angular velocity, its deviation and the deviation of the attitude, all in the body frame.
struct Turning {
  Vector3 omega, omega_change, turn;
  [[nodiscard]] Turning plus(const Turning& rate, double h) const {
    return {omega + h * rate.omega, omega_change + h * rate.omega_change, turn + h * rate.turn};
  }
};

/// Euler's equations and their linearisation: δθ̇ = δω − ω × δθ, I δω̇ = −δω × Iω − ω × Iδω.
Turning rate_of(const Body& body, const NewtonEuler& equations, const Turning& at) {
  const Vector3 momentum = body.inertia() * at.omega, momentum_change = body.inertia() * at.omega_change;
  return {equations.angular(at.omega, Vector3::Zero()),
          equations.response(momentum.cross(at.omega_change) + momentum_change.cross(at.omega)),
          at.omega_change - at.omega.cross(at.turn)};
}

Turning integrate(const Body& body, Turning at, double time) {
  const NewtonEuler equations(body.mass(), body.inertia());
  const double steps = std::clamp(std::ceil(at.omega.norm() * time / radians_per_step), 4.0, most_steps);
  const double h = time / steps;
  for (int i = 0; i < static_cast<int>(steps); ++i) {
    const Turning k1 = rate_of(body, equations, at);
    const Turning k2 = rate_of(body, equations, at.plus(k1, h / 2));
    const Turning k3 = rate_of(body, equations, at.plus(k2, h / 2));
    const Turning k4 = rate_of(body, equations, at.plus(k3, h));
    at = at.plus(k1, h / 6).plus(k2, h / 3).plus(k3, h / 3).plus(k4, h / 6);
  }
  return at;
}

// Blocks of a deviation.
auto shift(auto& d) { return d.template head<3>(); }
auto turn(auto& d) { return d.template segment<3>(3); }
auto velocity_change(auto& d) { return d.template segment<3>(6); }
auto angular_velocity_change(auto& d) { return d.template tail<3>(); }

}  // namespace

ErrorGrowth::ErrorGrowth(const Body& body, const MotionState& start, const Gravity& gravity, bool planar)
    : body_(body), gravity_(gravity), planar_(planar),
      speed_(start.velocity.norm() + body.radius() * start.angular_velocity.norm()) {
  if (!(speed_ > 0)) speed_ = std::sqrt(gravity.down * body.radius()) + 1e-300;
  deviation_ << 1, 1, -1, 1, -1, 1, 1, -1, -1, 1, 1, -1;
  if (planar) {
    const Vector3 north = start.attitude.conjugate() * Vector3::UnitY();
    shift(deviation_).y() = velocity_change(deviation_).y() = 0;
    turn(deviation_) = -north;
    angular_velocity_change(deviation_) = north;
  }
  deviation_.normalize();
}

MotionState ErrorGrowth::moved(const MotionState& state, double size) const {
  const double radius = body_.radius();
  MotionState other = state;
  other.centre += size * radius * shift(deviation_);
  const Vector3 half_turn = size / 2 * turn(deviation_);
  other.attitude = (state.attitude * Eigen::Quaterniond(1, half_turn.x(), half_turn.y(), half_turn.z())).normalized();
  other.velocity += size * speed_ * velocity_change(deviation_);
  other.angular_velocity += size * speed_ / radius * angular_velocity_change(deviation_);
  return other;
}

ErrorGrowth::Deviation ErrorGrowth::between(const MotionState& from, const MotionState& to) const {
  const double radius = body_.radius();
  Eigen::Quaterniond back_and_forth = from.attitude.conjugate() * to.attitude;
  if (back_and_forth.w() < 0) back_and_forth.coeffs() = -back_and_forth.coeffs();
  Deviation deviation;
  shift(deviation) = (to.centre - from.centre) / radius;
  turn(deviation) = 2 * back_and_forth.vec();
  velocity_change(deviation) = (to.velocity - from.velocity) / speed_;
  angular_velocity_change(deviation) = (to.angular_velocity - from.angular_velocity) * (radius / speed_);
  return deviation;
}

/// Goes on with `deviation`; one that cannot be measured leaves the last one standing.
void ErrorGrowth::take(const Deviation& deviation) {
  const double size = deviation.norm();
  if (!(size > 0) || !std::isfinite(size)) return;
  factor_ *= size;
  deviation_ = deviation / size;
}

void ErrorGrowth::fly(const MotionState& start, double time) {
  if (!(time > 0)) return;
  const double radius = body_.radius();
  Deviation moved = deviation_;
  shift(moved) += time * speed_ / radius * velocity_change(moved);
  if (planar_) {
    turn(moved) += time * speed_ / radius * angular_velocity_change(moved);
  } else {
    const Turning end =
        integrate(body_, {start.angular_velocity, speed_ / radius * angular_velocity_change(moved), turn(moved)}, time);
    turn(moved) = end.turn;
    angular_velocity_change(moved) = radius / speed_ * end.omega_change;
  }
  take(moved);
}

void ErrorGrowth::touch(const ContactRuns& runs, const ContactControl& control, const MotionState& touch,
                        const ContactResult& contact) {
  const double approach = -point_velocity(touch, touch_point(body_, touch)).z();
  if (!(approach > 0)) return;
  const double depth_part = contact.scales.depth / body_.radius();
  const double size = std::clamp(part_of_depth * depth_part, least_size, largest_size);
  const MotionState other = moved(touch, size);
  // The neighbour starts a little above the ground, before or after the touch-down.
  const double back = 4 * size * body_.radius() / approach;
  const FreeFlight flight(body_, other, gravity_, planar_);
  const MotionState above = flight.at(-back);
  const FreeFlight approach_flight(body_, above, gravity_, planar_);
  const TouchDown down = next_touch_down(body_, approach_flight);
  if (down.kind != TouchDown::Kind::touch) return;
  const MotionState start = approach_flight.at(down.time);
  ContactControl rough = control;
  rough.estimate_local_slip = false;
  rough.steps.tolerance = std::max(control.steps.tolerance, tolerance_per_size * size);
  // A contact whose own errors are as large as the deviation is compared with one that has the same.
  const bool is_fine = contact.step == 0 && control.steps.tolerance <= tolerance_per_size * size;
  ContactRun& run = is_fine ? runs.rough : runs.same;
  const ContactResult result = run.run(start, touch_point(body_, start), rough);
  if (result.ending != ContactEnding::lift_off) return;
  const double other_end = down.time - back + result.duration;
  const double end = std::max(contact.duration, other_end);
  const MotionState here = FreeFlight(body_, contact.after, gravity_, planar_).at(end - contact.duration);
  const MotionState there = FreeFlight(body_, result.after, gravity_, planar_).at(end - other_end);
  take(between(here, there) / size);
}

}  // namespace clatter::numeric
