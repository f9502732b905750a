#include "numeric/stepping/contact_run.hpp"

#include <boost/math/tools/toms748_solve.hpp>

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
constexpr double fading_per_contact = 50;    ///< rate at which stick ends a remaining slip, times the contact time
constexpr double minor_part = 1e-6;          ///< of energy or time: a friction phase below it does not name the mode
constexpr int most_switches = 8;             ///< of friction without a step between them

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
  phases_.clear();
  phases_.reserve(64);
  switches_ = 0;
  touches_.begin();
  now_.time = 0;
  now_.state = system_.initial();
  choose_first_phase(touch, point);
  now_.diagnosis = system_.diagnose(now_.state, now_.rate);
}

void ContactRun::step_to_the_end() {
  double h = scales_.time / adaptive_first_steps;
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
  close_phase();
  result_.duration = now_.time;
  result_.after = system_.motion(now_.state);
  result_.work_damping = now_.state[13];
  result_.work_released = now_.state[14];
  result_.work_friction = now_.state[15];
  result_.energy_stored = now_.diagnosis.load.energy;
  result_.mode = mode();
  result_.touches = std::max(touches_.touches(), 1);
  result_.end = touches_.touched_a() && touches_.touched_b() ? ContactEnd::both
                : touches_.touched_a()                        ? ContactEnd::a
                : touches_.touched_b()                        ? ContactEnd::b
                                                              : ContactEnd::middle;
}

void ContactRun::weigh_errors() {
  const double radius = system_.body().radius();
  weights_.head<3>().setConstant(scales_.depth);
  weights_.segment<4>(3).setConstant(scales_.depth / radius);
  weights_.segment<3>(7).setConstant(scales_.speed);
  weights_.segment<3>(10).setConstant(scales_.speed / radius);
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
  phase_start_ = now_.time;
  phase_work_ = now_.state[15];
  stopping_speed_ = 0;
  system_.set_phase({.kind = kind,
                     .direction = direction,
                     .slow = slow_part * std::sqrt(control_->tolerance) * scales_.speed,
                     .fading = fading_per_contact / scales_.time});
}

/// Notes the phase that ends, if it mattered: a sticking end slips for an instant when the force on it fades.
void ContactRun::close_phase() {
  const FrictionPhase& phase = system_.phase();
  const bool slips = phase.kind == Kind::slip;
  const bool matters = slips ? now_.state[15] - phase_work_ > minor_part * scales_.energy
                             : now_.time - phase_start_ > minor_part * scales_.time;
  if (matters && phases_.size() < phases_.capacity()) phases_.push_back({phase.kind, phase.direction});
}

/// One step of length h from `from`, with the numbers at its end; false if it failed.
bool ContactRun::try_step(const ContactInstant& from, double h, ContactInstant& to) {
  if (!stepper_.step(system_, from.state, from.rate, h, to.state, error_)) return false;
  to.state.segment<4>(3).normalize();
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
  if (order > 0) h = std::min(h, largest_part * horizon);
  for (;;) {
    if (system_.evaluations() >= control_->evaluation_limit) return end(ContactEnding::evaluation_limit);
    if (!(h > smallest_part * horizon)) return end(ContactEnding::step_too_small);
    if (!try_step(now_, h, trial_)) {
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
  if (handle_friction_event(h)) lifts = false;
  else accept(trial_);
  h = next;
  const bool goes_on = !control_->observe || control_->observe(now_);
  if (lifts) return end(ContactEnding::lift_off);
  if (at_rest(now_)) return end(ContactEnding::at_rest);
  return goes_on || end(ContactEnding::interrupted);
}

void ContactRun::accept(const ContactInstant& next) {
  touches_.update(submerged_);
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
  const double spin_speed = std::fabs(now_.diagnosis.spin) * system_.body().radius();
  phase.varies = spin_speed > 100 * control_->tolerance * scales_.speed;
  // Spin keeps the friction of a slow patch from stopping it in a finite time: it counts as stopped before.
  const double stopped = 1e-4 * spin_speed;
  stopping_speed_ = phase.varies && speed > 2 * stopped ? stopped : 0;
  system_.set_phase(phase);
}

/// A maximum of F_n inside the step: of the cubic through the forces and their rates at both ends, then of the
/// numerical solution there; what remains is of second order in the small error of its time.
void ContactRun::look_for_peak(const ContactInstant& next) {
  const auto note = [&](const ContactInstant& at) {
    if (!(at.diagnosis.load.force > result_.peak_force)) return;
    result_.peak_force = at.diagnosis.load.force;
    result_.peak_time = at.time;
  };
  note(next);
  const double h = next.time - now_.time;
  const double slope = h * now_.diagnosis.force_rate, end_slope = h * next.diagnosis.force_rate;
  if (!(slope >= 0) || !(end_slope <= 0) || slope == end_slope) return;
  const double rise = next.diagnosis.load.force - now_.diagnosis.load.force;
  // p′(s) = slope + 2 b s + 3 a s², which falls through 0 once in (0, 1].
  const double a = slope + end_slope - 2 * rise, b = 3 * rise - 2 * slope - end_slope;
  const double root = std::sqrt(std::max(b * b - 3 * a * slope, 0.0));
  const double s = b <= 0 ? slope / (root - b) : (-b - root) / (3 * a);
  if (!(s > 0 && s < 1)) return;
  const double top = now_.diagnosis.load.force + s * (slope + s * (b + s * a));
  if (!(top > 0.9 * result_.peak_force) || !try_step(now_, s * h, probe_)) return;
  note(probe_);
  peak_ = probe_;
  const double at_probe = h * probe_.diagnosis.force_rate;
  const double other_s = at_probe > 0 ? 1 : 0, other = at_probe > 0 ? end_slope : slope;
  const double better = s - at_probe * (other_s - s) / (other - at_probe);
  if (better > 0 && better < 1 && try_step(now_, better * h, probe_)) note(probe_);
  if (probe_.time == result_.peak_time) peak_ = probe_;
  if (control_->observe && peak_.time == result_.peak_time) control_->observe(peak_);
}

double ContactRun::slip_forward(const ContactInstant& at) const {
  if (!(at.diagnosis.load.force > 0)) return scales_.speed;
  return at.diagnosis.slip.dot(system_.phase().direction) - stopping_speed_;
}

double ContactRun::stick_reserve(const ContactInstant& at) const {
  const double force = at.diagnosis.load.force;
  return force > 0 ? system_.ground().static_friction * force - at.diagnosis.friction.norm() : 0;
}

/// If slip ends or stick gives way within the step that led to trial_, moves there and changes the phase.
bool ContactRun::handle_friction_event(double h) {
  const Kind kind = system_.phase().kind;
  if (kind != Kind::slip && kind != Kind::stick) return false;
  const Indicator indicator = kind == Kind::slip ? &ContactRun::slip_forward : &ContactRun::stick_reserve;
  const bool happens = kind == Kind::slip ? !((this->*indicator)(trial_) > 0) : (this->*indicator)(trial_) < 0;
  if (!happens || ++switches_ > most_switches) return false;
  const int switches = switches_;
  if ((this->*indicator)(now_) > 0) {
    static_cast<void>(locate(indicator, h, trial_));
    accept(trial_);
  }
  switches_ = switches;
  close_phase();
  const AlongGround hold = system_.sticking_force(trial_.state);
  const AlongGround& against = kind == Kind::stick ? trial_.diagnosis.friction : hold;
  const double normal = trial_.diagnosis.load.force;
  const bool can_hold = kind == Kind::slip && hold.norm() <= system_.ground().static_friction * normal;
  if (can_hold) {
    start_phase(Kind::stick, {});
  } else {
    const double size = against.norm();
    const AlongGround direction = size > 0 ? against * (-1 / size) : system_.phase().direction;
    start_phase(Kind::slip, direction);
  }
  now_.diagnosis = system_.diagnose(now_.state, now_.rate);
  return true;
}

/// The length of the step at whose end the indicator has just fallen to 0; at_root gets that instant.
double ContactRun::locate(Indicator indicator, double h, ContactInstant& at_root) {
  const auto value = [&](double length) {
    return length <= 0 ? (this->*indicator)(now_)
           : try_step(now_, length, probe_) ? (this->*indicator)(probe_)
                                            : -std::numeric_limits<double>::min();
  };
  const double resolution = 1e-14 * (scales_.time + now_.time);
  std::uintmax_t iterations = 50;
  const auto [low, high] = boost::math::tools::toms748_solve(
      value, 0.0, h, (this->*indicator)(now_), (this->*indicator)(at_root),
      [&](double a, double b) { return b - a <= resolution; }, iterations);
  static_cast<void>(low);
  static_cast<void>(try_step(now_, high, at_root));
  return high;
}

/// The length of the step at whose end the deepest vertex is just out of the ground, by Newton's method in a
/// bracket; at_root, given at h, gets that instant.
double ContactRun::lift_off_time(double h, ContactInstant& at_root) {
  const double resolution = 1e-13 * scales_.depth;
  double low = 0, high = h, length = h;
  for (int i = 0; i < 100; ++i) {
    const double depth = at_root.diagnosis.load.deepest, rate = at_root.diagnosis.load.deepest_rate;
    if (std::fabs(depth) <= resolution || high - low <= 1e-14 * (scales_.time + now_.time)) break;
    (depth > 0 ? low : high) = length;
    const bool seen = depth > -0.5 * system_.body().radius();  // facets far above the ground are not looked at
    const double newton = seen && rate < 0 ? length - depth / rate : low;
    length = newton > low && newton < high ? newton : (low + high) / 2;
    if (!try_step(now_, length, at_root)) break;
  }
  return length;
}

/// Motion and acceleration a millionth of what a fall into this contact would have.
bool ContactRun::at_rest(const ContactInstant& at) const {
  const double g = system_.gravity();
  const double depth = at.diagnosis.load.deepest;
  if (!(g > 0) || !(depth > 0)) return false;
  const double radius = system_.body().radius();
  const double speed = 1e-6 * std::sqrt(g * depth), acceleration = 1e-6 * g;
  return at.state.segment<3>(7).norm() <= speed && radius * at.state.segment<3>(10).norm() <= speed &&
         at.rate.segment<3>(7).norm() <= acceleration && radius * at.rate.segment<3>(10).norm() <= acceleration;
}

FrictionMode ContactRun::mode() const {
  const Ground& ground = system_.ground();
  if (!ground.has_friction()) return FrictionMode::frictionless;
  if (ground.friction == FrictionLaw::regularised) return FrictionMode::regularised;
  const auto is = [](Kind kind) { return [kind](const PhaseLog& phase) { return phase.kind == kind; }; };
  const auto slip = std::find_if(phases_.begin(), phases_.end(), is(Kind::slip));
  if (slip == phases_.end()) return FrictionMode::stick;
  const bool reverses = std::any_of(slip, phases_.end(), [&](const PhaseLog& phase) {
    return phase.kind == Kind::slip && phase.direction.dot(slip->direction) < 0;
  });
  if (reverses) return FrictionMode::reverse_slip;
  const auto stick = std::find_if(phases_.begin(), phases_.end(), is(Kind::stick));
  if (stick == phases_.end()) return FrictionMode::slip;
  return stick < slip ? FrictionMode::stick_slip : FrictionMode::slip_stick;
}

}  // namespace clatter::numeric
