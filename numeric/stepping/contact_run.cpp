#include "numeric/stepping/contact_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/stepping/contact_scales.hpp"

namespace clatter::numeric {
namespace {

using Kind = FrictionPhase::Kind;

constexpr double adaptive_first_steps = 20;  ///< first step: this part of the expected contact time
constexpr double largest_part = 0.2;         ///< of that time, or of the time so far, that a step may cover
constexpr double fewest_steps = 4;           ///< of fixed length, in the expected contact time
constexpr double smallest_part = 1e-13;
/// Slip slower than this part, times √tolerance, of the contact's speed keeps its direction: across it friction is a
/// damper that stiffens like 1/|v|, which explicit steps could not follow.
constexpr double slow_part = 0.1;
/// Part of the speed and acceleration of a fall below which a body lies still, and how many times the tolerance the
/// errors of steps keep up, so that a rough run ends too.
constexpr double least_rest = 1e-6, largest_rest = 1e-5, noise_per_tolerance = 300;
constexpr double least_spin = 1;           ///< times tolerance and the contact's speed: slip from spin that counts
constexpr double fading_per_contact = 50;  ///< rate at which stick ends a remaining slip, times the contact time

}  // namespace

ContactRun::ContactRun(ContactSystem& system, Stepper& stepper)
    : system_(system), stepper_(stepper), touches_(system.body()) {
  submerged_.reserve(system.body().facets().corners.size());
}

ContactResult ContactRun::run(const MotionState& touch, const Vector3& point, const ContactControl& control) {
  control_ = &control;
  system_.begin(touch);
  scales_ = contact_scales(system_, touch, point);
  result_ = {};
  result_.scales = scales_;
  if (!std::isfinite(scales_.time) || !(scales_.depth > 1e-14 * system_.body().radius())) {
    result_.ending = ContactEnding::not_representable;
    return result_;
  }
  begin(touch, point);
  result_.ending = ContactEnding::interrupted;
  if (control.observe && !control.observe(now_)) return result_;
  step_to_the_end();
  collect();
  return result_;
}

void ContactRun::begin(const MotionState& touch, const Vector3& point) {
  weigh_errors();
  log_.begin(scales_, system_.body().mass());
  local_slip_.begin();
  switches_ = 0;
  touches_.begin();
  now_.time = 0;
  now_.state = system_.initial();
  choose_first_phase(touch, point);
  now_.diagnosis = system_.diagnose(now_.state, now_.rate);
}

void ContactRun::step_to_the_end() {
  double h = control_->step_cap * scales_.time / adaptive_first_steps;
  if (stepper_.error_order() > 0) {
    while (advance(h)) continue;
    return;
  }
  result_.step = control_->step > 0 ? std::min(control_->step, scales_.time / fewest_steps)
                                    : scales_.time / control_->steps_per_contact;
  h = control_->first_step > 0 ? std::min(control_->first_step, result_.step) : result_.step;
  while (advance(h)) h = result_.step;
}

void ContactRun::collect() {
  log_.close(system_.phase(), sums());
  result_.duration = now_.time;
  result_.after = system_.motion(now_.state);
  result_.work_damping = now_.state[13];
  result_.work_released = now_.state[14];
  result_.work_friction = now_.state[15];
  result_.energy_stored = now_.diagnosis.load.energy;
  result_.mode = mode();
  result_.local_slip = local_slip_.impulse();
  result_.touches = std::max(touches_.touches(), 1);
  result_.end = touches_.touched_a() && touches_.touched_b() ? ContactEnd::both
                : touches_.touched_a()                       ? ContactEnd::a
                : touches_.touched_b()                       ? ContactEnd::b
                                                             : ContactEnd::middle;
}

void ContactRun::weigh_errors() {
  const double radius = system_.body().radius();
  weights_.head<3>().setConstant(scales_.depth);
  euler_parameters(weights_).setConstant(scales_.depth / radius);
  velocity(weights_).setConstant(scales_.speed);
  angular_velocity(weights_).setConstant(scales_.speed / radius);
  weights_.tail<3>().setConstant(scales_.energy);
  weights_ *= control_->tolerance;
}

/// Without slip at touch-down the light first load tells whether the contact sticks.
void ContactRun::choose_first_phase(const MotionState& touch, const Vector3& point) {
  const Ground& ground = system_.ground();
  const AlongGround none;
  if (!ground.has_friction()) return start_phase(Kind::none, none);
  if (ground.friction == FrictionLaw::regularised) return start_phase(Kind::regularised, none);
  const Vector3 moving = touch.velocity + touch.attitude * touch.angular_velocity.cross(point);
  const AlongGround slip{moving.x(), system_.planar() ? 0.0 : moving.y()};
  const double speed = slip.norm();
  if (speed > 1e-12 * std::max(scales_.speed, touch.velocity.norm())) {
    return start_phase(Kind::slip, slip * (1 / speed));
  }
  const AlongGround ratio = system_.sticking_ratio(point);
  if (ratio.norm() <= ground.static_friction) return start_phase(Kind::stick, none);
  start_phase(Kind::slip, ratio * (-1 / ratio.norm()));
}

void ContactRun::start_phase(FrictionPhase::Kind kind, const AlongGround& direction) {
  log_.open(sums());
  stopping_speed_ = 0;
  FrictionPhase phase{.kind = kind,
                      .direction = direction,
                      .slow = slow_part * std::sqrt(control_->tolerance) * scales_.speed,
                      .fading = fading_per_contact / scales_.time};
  if (kind == Kind::slip && !system_.planar()) note_variation(phase);
  system_.set_phase(phase);
}

/// Whether the patch spins noticeably; returns how fast its farthest point might.
double ContactRun::note_variation(FrictionPhase& phase) const {
  if (control_->point_friction) return 0;
  const double spin_speed = std::fabs(system_.vertical_spin(now_.state)) * system_.body().radius();
  phase.varies = spin_speed > least_spin * control_->tolerance * scales_.speed;
  return spin_speed;
}

FrictionLog::Sums ContactRun::sums() const {
  const double speed = now_.state[9] - system_.initial()[9] + system_.gravity() * now_.time;
  return {now_.time, now_.state[15], system_.body().mass() * speed};
}

/// One step of length h from `from`, with the numbers at its end; false if it failed.
bool ContactRun::try_step(const ContactInstant& from, double h, ContactInstant& to) {
  if (!stepper_.step(system_, from.state, from.rate, h, to.state, error_)) return false;
  euler_parameters(to.state).normalize();
  to.time = from.time + h;
  submerged_.clear();
  to.diagnosis = system_.diagnose(to.state, to.rate, &submerged_);
  return to.rate.allFinite();
}

double ContactRun::error_of_step() const { return (error_.cwiseAbs().cwiseQuotient(weights_)).maxCoeff(); }

bool ContactRun::end(ContactEnding ending) {
  result_.ending = ending;
  return false;
}

/// A contact shorter than the step, or the gap between two, must not be stepped over.
bool ContactRun::stepped_over() const {
  const bool shorter = now_.time == 0 && !(trial_.diagnosis.load.deepest > 0);
  return shorter || touches_.all_new(submerged_);
}

/// Steps of at most length h until one is accurate enough; trial_ gets its end and `h` its length, `next` the length
/// to try after it.  False, with the ending set, if there is none.
bool ContactRun::find_step(double& h, double& next) {
  const int order = stepper_.error_order();
  const double horizon = std::max(scales_.time, now_.time);
  bool is_number = true;  // of the last trial
  if (order > 0) h = std::min(h, control_->step_cap * largest_part * horizon);
  for (;;) {
    if (system_.evaluations() >= control_->evaluation_limit) return end(ContactEnding::evaluation_limit);
    if (!(h > smallest_part * horizon)) {
      return end(is_number ? ContactEnding::step_too_small : ContactEnding::not_representable);
    }
    is_number = try_step(now_, h, trial_);
    if (!is_number) {
      h /= 8;
      continue;
    }
    const double error = order > 0 ? error_of_step() : 0;
    const double growth = order > 0 ? 0.9 * std::pow(error, -1.0 / order) : 1;
    if (!(error <= 1)) {
      h *= std::clamp(growth, 0.1, 0.7);
    } else if (stepped_over() && h > 1e-9 * scales_.time) {
      h /= 2;
    } else {
      next = h * std::clamp(growth, 0.2, 4.0);
      return true;
    }
  }
}

/// One accepted step, cut short where an event lies in it; false, with the ending set, at the end of the contact.
/// `h` is the length to try, then the next one.
bool ContactRun::advance(double& h) {
  double next = h;
  if (!find_step(h, next)) return false;
  bool lifts = !(trial_.diagnosis.load.deepest > 0);
  if (lifts && now_.diagnosis.load.deepest > 0) h = lift_off_time(h, trial_);
  const double began = now_.time;
  if (handle_friction_event(h)) lifts = false;
  else accept(trial_);
  if (control_->estimate_local_slip) local_slip_.advance(system_, trial_.state, trial_.diagnosis, now_.time - began);
  if (!lifts) watch_local_slip();
  h = next;
  const bool goes_on = !control_->observe || control_->observe(now_);
  if (lifts) return end(ContactEnding::lift_off);
  if (ends_on_the_ground(now_)) return false;
  return goes_on || end(ContactEnding::interrupted);
}

void ContactRun::accept(const ContactInstant& next) {
  touches_.update(submerged_);
  result_.submerged = result_.submerged || system_.is_submerged(next.state);
  look_for_peak(next);
  now_ = next;
  switches_ = 0;
  FrictionPhase phase = system_.phase();
  if (phase.kind != Kind::slip || system_.planar()) return;
  const AlongGround& slip = now_.diagnosis.slip;
  const double speed = slip.norm();
  // Slip that has hardly begun keeps the direction in which it was let go.
  const AlongGround leaning{slip.east + phase.slow * phase.direction.east,
                            slip.north + phase.slow * phase.direction.north};
  const double size = leaning.norm();
  if (now_.diagnosis.load.force > 0 && size > 0) phase.direction = leaning * (1 / size);
  const double spin_speed = note_variation(phase);
  // Spin keeps the friction of a slow patch from stopping it in a finite time: it counts as stopped before.
  const double stopped = 1e-4 * spin_speed;
  stopping_speed_ = phase.varies && speed > 2 * stopped ? stopped : 0;
  system_.set_phase(phase);
}

/// Whether only sliding along the ground and spinning about the vertical are left, neither with an acceleration: to a
/// millionth of what a fall into this contact would have, or to what the tolerance's errors keep up.
bool ContactRun::is_steady(const ContactInstant& at) const {
  const double g = system_.gravity();
  const double depth = at.diagnosis.load.deepest;
  if (!(g > 0) || !(depth > 0)) return false;
  const double radius = system_.body().radius(), fall = std::sqrt(g * depth);
  const double noise =
      stepper_.error_order() > 0 ? noise_per_tolerance * control_->tolerance * scales_.speed / fall : 0;
  const double part = std::clamp(noise, least_rest, largest_rest);
  const double turning = angular_velocity(at.state).norm(), spin = at.diagnosis.spin;
  const double tipping = std::sqrt(std::max(turning * turning - spin * spin, 0.0));
  return std::fabs(at.state[9]) <= part * fall && radius * tipping <= part * fall + 1e-7 * radius * turning &&
         velocity(at.rate).norm() <= part * g && radius * angular_velocity(at.rate).norm() <= part * g;
}

/// What is left of a steady motion: nothing, or what no friction will ever stop.
bool ContactRun::ends_on_the_ground(const ContactInstant& at) {
  if (!is_steady(at)) return false;
  const double speed = least_rest * std::sqrt(system_.gravity() * at.diagnosis.load.deepest);
  const double sliding = std::hypot(at.state[7], at.state[8]);
  const double turning = system_.body().radius() * std::fabs(at.diagnosis.spin);
  if (sliding <= speed && turning <= speed) {
    result_.ending = ContactEnding::at_rest;
    return true;
  }
  result_.ending = ContactEnding::sustained_contact;
  return goes_on_for_ever();
}

/// Sliding without friction, or spinning about a pressure centre that sticks, which this law does not resist.
bool ContactRun::goes_on_for_ever() const {
  return system_.ground().sliding_friction == 0 || system_.phase().kind == Kind::stick;
}

FrictionMode ContactRun::mode() const {
  const Ground& ground = system_.ground();
  if (!ground.has_friction()) return FrictionMode::frictionless;
  if (ground.friction == FrictionLaw::regularised) return FrictionMode::regularised;
  return ground.friction == FrictionLaw::local ? FrictionMode::local : log_.mode();
}

}  // namespace clatter::numeric
