// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/contact_run.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/stepping/contact_scales.hpp"
#include "numeric/stepping/resting.hpp"

namespace clatter::numeric {
namespace {

constexpr int most_switches = 8;            ///< of friction without a step between them
constexpr double least_depth_seen = 1e-14;  ///< of the body's radius: shallower contacts are rounding

ContactEnd end_of(const TouchCounter& touches) {
  if (touches.touched_a() && touches.touched_b()) return ContactEnd::both;
  if (touches.touched_a()) return ContactEnd::a;
  return touches.touched_b() ? ContactEnd::b : ContactEnd::middle;
}

}  // namespace

ContactRun::ContactRun(ContactSystem& system, Stepper& stepper)
    : system_(system), step_(system, stepper), steps_(step_), events_(step_), peak_(step_), friction_(system),
      touches_(system.body()) {}

ContactResult ContactRun::run(const MotionState& touch, const Vector3& point, const ContactControl& control) {
  control_ = &control;
  system_.begin(touch);
  result_ = {};
  result_.scales = contact_scales(system_, touch, point);
  if (!std::isfinite(result_.scales.time) || !(result_.scales.depth > least_depth_seen * system_.body().radius())) {
    result_.ending = ContactEnding::not_representable;
    return result_;
  }
  begin(touch, point);
  result_.ending = ContactEnding::interrupted;
  if (control.observe && !control.observe(now_)) return result_;
  result_.ending = step_to_the_end();
  collect();
  return result_;
}

void ContactRun::begin(const MotionState& touch, const Vector3& point) {
  const ContactScales& scales = result_.scales;
  steps_.begin(control_->steps, scales, control_->evaluation_limit);
  events_.begin(scales);
  peak_.begin();
  local_slip_.begin();
  touches_.begin();
  switches_ = 0;
  now_.time = 0;
  now_.state = system_.initial();
  friction_.begin(touch, point, scales,
                  {.tolerance = control_->steps.tolerance,
                   .fixed_step = steps_.fixed(),
                   .point_friction = control_->point_friction},
                  now_);
  now_.diagnosis = system_.diagnose(now_.state, now_.rate);
}

ContactEnding ContactRun::step_to_the_end() {
  result_.step = steps_.fixed();
  for (;;) {
    if (const std::optional<ContactEnding> ending = advance()) return *ending;
  }
}

/// One accepted step, cut short where an event lies in it; the ending if that ends the contact.
std::optional<ContactEnding> ContactRun::advance() {
  if (const auto ending = steps_.find(now_, touches_, trial_)) return ending;
  double h = steps_.taken();
  bool lifts = !(trial_.diagnosis.load.deepest > 0);
  if (lifts && now_.diagnosis.load.deepest > 0) h = events_.lift_off(now_, h, trial_);
  const double began = now_.time;
  if (handle_friction_event(h)) lifts = false;
  else accept(trial_);
  if (control_->estimate_local_slip) local_slip_.advance(system_, trial_.state, trial_.diagnosis, now_.time - began);
  if (!lifts) friction_.choose_local_slip(now_);
  const bool goes_on = !control_->observe || control_->observe(now_);
  if (lifts) return ContactEnding::lift_off;
  if (const auto ending = ending_on_the_ground(system_, now_, kept_up())) return ending;
  if (!goes_on) return ContactEnding::interrupted;
  return std::nullopt;
}

double ContactRun::kept_up() const {
  return step_.error_order() > 0 ? kept_up_speed(control_->steps.tolerance, result_.scales.speed) : 0;
}

/// If slip ends or stick gives way within the step that led to trial_, moves there and changes the phase.  A step that
/// ends with hardly a force is judged by the last instant that has one.
bool ContactRun::handle_friction_event(double h) {
  if (!friction_.can_end()) return false;
  if (friction_.is_faint(trial_)) {
    if (friction_.is_faint(now_)) return false;
    faint_ = trial_;
    const auto force = [this](const ContactInstant& at) { return friction_.force_to_judge(at); };
    h = events_.fall(force, now_, h, trial_);
    if (!friction_.is_over(trial_)) trial_ = faint_;
  }
  if (!friction_.is_over(trial_) || ++switches_ > most_switches) return false;
  const int switches = switches_;
  const auto reserve = [this](const ContactInstant& at) { return friction_.reserve(at); };
  if (friction_.reserve(now_) > 0) {
    static_cast<void>(events_.fall(reserve, now_, h, trial_));
    accept(trial_);
  }
  switches_ = switches;
  friction_.change(trial_, now_);
  return true;
}

void ContactRun::accept(const ContactInstant& next) {
  touches_.update(step_.submerged());
  result_.submerged = result_.submerged || system_.is_submerged(next.state);
  const ContactInstant* peak = peak_.look(now_, next);
  if (peak && control_->observe) control_->observe(*peak);
  now_ = next;
  switches_ = 0;
  friction_.follow(now_);
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
  result_.mode = friction_.end(now_);
  result_.local_slip = local_slip_.impulse();
  result_.touches = std::max(touches_.touches(), 1);
  result_.end = end_of(touches_);
}

}  // namespace clatter::numeric
