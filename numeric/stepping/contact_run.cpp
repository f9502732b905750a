// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/contact_run.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace clatter::numeric {
namespace {

constexpr double unit_rounding = 1e-14;     ///< of the Euler parameters, which each step makes unit again
constexpr int most_switches = 8;            ///< of friction without a step between them
constexpr double light_per_faint = 1e3;     ///< a force that is judged as the last one: at most so many faint ones
constexpr double least_depth_seen = 1e-14;  ///< of the body's radius: shallower contacts are rounding

/// Mass that the touching point seems to have for a vertical push.
double effective_mass(const Body& body, const MotionState& touch, const Vector3& point) {
  const Vector3 arm = point.cross(touch.attitude.conjugate() * Vector3::UnitZ());
  return 1 / (1 / body.mass() + arm.dot(body.inverse_inertia() * arm));
}

/// From the depth to which the body, pushed straight down at its touch-down attitude, takes up the energy that its
/// touching point `point` (body frame) brings:
///     (1 + c_G v/k_G) U(depth) = ½ m_eff v² + m g depth.
/// `system` has begun with `touch`.  Not finite if there is no such depth.  A body that is pressed has its depth and
/// its springs' energy already.
ContactScales contact_scales(ContactSystem& system, const MotionState& touch, const Vector3& point, bool is_pressed) {
  const Body& body = system.body();
  const double g = system.gravity();
  const double fall = -(touch.velocity + touch.attitude * touch.angular_velocity.cross(point)).z();
  const double speed = is_pressed ? std::fabs(fall) : std::max(fall, 0.0);
  const ContactLoad begun = is_pressed ? system.pressed(0) : ContactLoad{};
  const double kinetic = 0.5 * effective_mass(body, touch, point) * speed * speed;
  const Ground& ground = system.ground();
  const double stiffening =
      1 + (ground.has_dissipation() ? ground.dissipation * speed : ground.damping * speed / ground.stiffness);
  const auto takes_it_up = [&](double depth) {
    return stiffening * (system.pressed(depth).energy - begun.energy) >= kinetic + body.mass() * g * depth;
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
  high += begun.deepest;
  scales.depth = high;
  scales.speed = std::sqrt(speed * speed + 2 * g * high + 2 * begun.energy / body.mass());
  scales.time = scales.speed > 0 ? 3 * high / scales.speed : std::numeric_limits<double>::infinity();
  scales.energy = kinetic + body.mass() * g * high + begun.energy;
  return scales;
}

/// How many times the tolerance the errors of steps keep up, so that a rough run ends too.
constexpr double noise_per_tolerance = 300;

}  // namespace

ContactRun::ContactRun(ContactSystem& system, Stepper& stepper)
    : system_(system), step_(system, stepper), steps_(step_), events_(step_), peak_(step_), deepest_(step_),
      friction_(system), touches_(system.body()) {}

ContactResult ContactRun::run(const MotionState& touch, const Vector3& point, const ContactControl& control,
                              const ContactObserver& observer, const StepObserver& steps) {
  control_ = &control;
  observer_ = &observer;
  shown_ = &steps;
  system_.begin(touch);
  result_ = {};
  result_.scales = contact_scales(system_, touch, point, control.is_pressed);
  if (!std::isfinite(result_.scales.time) || !(result_.scales.depth > least_depth_seen * system_.body().radius())) {
    result_.ending = ContactEnding::not_representable;
    return result_;
  }
  begin(touch, point);
  result_.ending = ContactEnding::interrupted;
  if (observer && !observer(now_)) return result_;
  result_.step = steps_.fixed();
  std::optional<ContactEnding> ending;
  if (control.is_pressed) ending = ending_on_the_ground();
  while (!ending) ending = advance();
  result_.ending = *ending;
  collect();
  return result_;
}

void ContactRun::begin(const MotionState& touch, const Vector3& point) {
  const ContactScales& scales = result_.scales;
  steps_.begin(control_->steps, scales, control_->evaluation_limit);
  events_.begin(scales, control_->steps.tolerance);
  peak_.begin();
  deepest_.begin();
  local_slip_.begin(control_->least_local_slip * scales.energy / scales.depth);
  touches_.begin(point);
  rocking_.begin(system_.evaluations());
  switches_ = 0;
  next_time_ = 0;
  now_.time = 0;
  now_.state = system_.initial();
  friction_.begin(touch, point, scales,
                  {.tolerance = control_->steps.tolerance,
                   .fixed_step = steps_.fixed(),
                   .point_friction = control_->point_friction,
                   .is_pressed = control_->is_pressed},
                  now_);
  now_.diagnosis = system_.diagnose(now_.state, now_.rate);
  if (!control_->is_pressed) return;
  peak_.begin(now_.diagnosis.load.force);
  deepest_.begin(now_.diagnosis.load.deepest);
}

/// One accepted step, cut short where an event lies in it; the ending if that ends the contact.
std::optional<ContactEnding> ContactRun::advance() {
  if (const auto ending = steps_.find(now_, touches_, trial_)) return ending;
  double h = steps_.taken();
  bool lifts = !(trial_.diagnosis.load.deepest > 0);
  if (lifts && now_.diagnosis.load.deepest > 0) h = events_.lift_off(now_, h, trial_);
  const double began = now_.time;
  if (handle_friction_event(h)) {
    lifts = false;
  } else {
    accept(trial_);
    switches_ = 0;
  }
  if (control_->estimate_local_slip) local_slip_.advance(system_, trial_.state, trial_.diagnosis, now_.time - began);
  if (!lifts) friction_.choose_local_slip(now_);
  const bool goes_on = !*observer_ || (*observer_)(now_);
  if (lifts) return ContactEnding::lift_off;
  if (const auto ending = ending_on_the_ground()) return ending;
  if (!goes_on) return ContactEnding::interrupted;
  return std::nullopt;
}

std::optional<ContactEnding> ContactRun::ending_on_the_ground() {
  result_.goes_on = motion_on_the_ground(system_, now_, kept_up_speed());
  if (!result_.goes_on) result_.goes_on = rocking_.look(system_, now_);
  if (!result_.goes_on) return std::nullopt;
  const bool rests = result_.goes_on->kind == GroundMotionKind::rests;
  return rests ? ContactEnding::at_rest : ContactEnding::sustained_contact;
}

/// Speed that the errors of steps keep up in a body that ought to lie still [m/s].
double ContactRun::kept_up_speed() const {
  return step_.error_order() > 0 ? noise_per_tolerance * control_->steps.tolerance * result_.scales.speed : 0;
}

/// If slip ends or stick gives way within the step that led to trial_, moves there and changes the phase.  A step that
/// ends with hardly a force is judged by the last instant that has one.
bool ContactRun::handle_friction_event(double h) {
  if (!friction_.can_end()) return false;
  const double faint = friction_.faint_force(), light = light_per_faint * faint;
  if (!(trial_.diagnosis.load.force > faint)) {
    if (!(now_.diagnosis.load.force > light)) return false;
    faint_ = trial_;
    h = events_.fade(faint, light, now_, h, trial_);
    if (!friction_.is_over(trial_)) trial_ = faint_;
  }
  if (!friction_.is_over(trial_) || ++switches_ > most_switches) return false;
  const auto reserve = [this](const ContactInstant& at) { return friction_.reserve(at); };
  if (friction_.reserve(now_) > 0) {
    static_cast<void>(events_.fall(reserve, now_, h, trial_));
    accept(trial_);
  }
  friction_.change(trial_, now_);
  return true;
}

void ContactRun::accept(const ContactInstant& next) {
  assert(next.time >= now_.time);
  assert(std::fabs(euler_parameters(next.state).norm() - 1) <= unit_rounding);
  touches_.update(step_.submerged());
  result_.submerged = result_.submerged || system_.is_submerged(next.state);
  const ContactInstant* peak = peak_.look(now_, next);
  if (peak && *observer_) (*observer_)(*peak);
  deepest_.look(now_, next);
  if (shown_->show) show_step(next);
  if (next_time_ < shown_->times.size()) show_times(next);
  now_ = next;
  friction_.follow(now_);
}

/// A step of no length, to an event where the step before it ended, is not shown, nor one of which an instant is no
/// number.
void ContactRun::show_step(const ContactInstant& next) {
  const double h = next.time - now_.time;
  if (!(h > 0)) return;
  inside_.resize(shown_->parts.size());
  inside_.front() = now_;
  inside_.back() = next;
  for (std::size_t i = 1; i + 1 < inside_.size(); ++i) {
    if (!step_.take(now_, shown_->parts[i] * h, inside_[i])) return;
  }
  shown_->show(inside_);
}

void ContactRun::show_times(const ContactInstant& next) {
  const long evaluations = system_.evaluations();
  for (; next_time_ < shown_->times.size() && shown_->times[next_time_] < next.time; ++next_time_) {
    const double h = shown_->times[next_time_] - now_.time;
    const bool is_number = !(h > 0) || step_.take(now_, h, aside_);
    shown_->at_time(next_time_, !is_number ? nullptr : h > 0 ? &aside_ : &now_);
  }
  system_.set_aside(system_.evaluations() - evaluations);
}

void ContactRun::collect() {
  result_.duration = now_.time;
  result_.after = system_.motion(now_.state);
  result_.work_damping = damping_work(now_.state);
  result_.work_released = released_work(now_.state);
  result_.work_friction = friction_work(now_.state);
  result_.energy_stored = now_.diagnosis.load.energy;
  result_.peak_force = peak_.force();
  result_.peak_time = peak_.time();
  result_.indentation = deepest_.depth();
  result_.mode = friction_.end(now_);
  result_.left_out = friction_.left_out(now_.time);
  result_.local_slip = local_slip_.impulse();
  result_.touches = std::max(touches_.touches(), 1);
  result_.end = contact_end(touches_.touched_a(), touches_.touched_b());
  result_.goes_on_from = now_.time;
  const std::optional<GroundMotion>& motion = result_.goes_on;
  if (motion && motion->kind == GroundMotionKind::rests && (motion->stops_after > 0 || motion->rocks))
    come_to_rest(*motion);
}

/// Friction takes what the body moves with along the ground and falls by on its way, the dampers what is left of other
/// motion and what its tilt sets free at the end.
void ContactRun::come_to_rest(const GroundMotion& motion) {
  const double mass = system_.body().mass();
  const Vector3 v = velocity(now_.state), turning = angular_velocity(now_.state);
  const bool slides = motion.stops_after > 0;
  const MotionState end = slides ? motion.at(std::nextafter(motion.stops_after, 0.0)) : motion.from;
  const Vector3 way = end.centre - motion.from.centre, turned = end.centre - motion.rest.state.centre;
  const double tipped = mass * (system_.gravity() * turned.z() - system_.gravity_along() * turned.x()) +
                        motion.energy_stored - motion.rest.energy_stored;
  const double along = mass * (v.head<2>().squaredNorm() / 2 + system_.gravity_along() * way.x());
  if (slides) result_.work_friction += along;
  result_.work_damping += std::max(
      (slides ? 0 : along) + tipped + mass * v.z() * v.z() / 2 + turning.dot(system_.body().inertia() * turning) / 2,
      0.0);
  result_.duration += motion.stops_after;
  if (result_.mode == FrictionMode::stick) result_.mode = FrictionMode::slip;  // nothing had slipped before
  result_.after = motion.rest.state;
  result_.energy_stored = motion.rest.energy_stored;
}

}  // namespace clatter::numeric
