// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/contact_run.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "numeric/motion/free_flight.hpp"
#include "numeric/stepping/friction_phases.hpp"
#include "numeric/stepping/steady_motion.hpp"
#include "numeric/stepping/touch_counter.hpp"

namespace clatter::numeric {
namespace {

constexpr double adaptive_first_steps = 20;  ///< first step: this part of the expected contact time
constexpr double largest_part = 0.2;         ///< of that time, or of the time so far, that a step may cover
constexpr double smallest_part = 1e-13;
constexpr double fewest_steps = 4;           ///< of fixed length, in the expected contact time
constexpr double least_over_touches = 1e-9;  ///< of that time: steps this short may step over a touch

constexpr double resolved_part = 1e-3;  ///< of the tolerance: an event's time over the contact's

struct Depth {
  double value, rate;  ///< [m], [m/s]
};

/// The cubic over a step, 0 at its beginning.
struct StepCubic {
  double slope, end_slope;  ///< rates times the length of the step
  double rise;              ///< value at the end
};

/// Where in the step, from 0 to 1, the cubic has a maximum: p′(s) = slope + 2 b s + 3 a s² falls through 0 there once;
/// 0 where it has none inside.
double place_of_top(const StepCubic& p) {
  if (!(p.slope >= 0) || !(p.end_slope <= 0) || p.slope == p.end_slope) return 0;
  const double a = p.slope + p.end_slope - 2 * p.rise, b = 3 * p.rise - 2 * p.slope - p.end_slope;
  const double root = std::sqrt(std::max(b * b - 3 * a * p.slope, 0.0));
  const double s = b <= 0 ? p.slope / (root - b) : (-b - root) / (3 * a);
  return s > 0 && s < 1 ? s : 0;
}

/// What the cubic rises to at the part s of the step.
double rise_to(const StepCubic& p, double s) {
  const double a = p.slope + p.end_slope - 2 * p.rise, b = 3 * p.rise - 2 * p.slope - p.end_slope;
  return s * (p.slope + s * (b + s * a));
}

/// Depth of the deepest vertex; the load looks at no facet above the ground.
Depth deepest_point(const ContactSystem& system, const ContactInstant& at) {
  const ContactLoad& load = at.diagnosis.load;
  if (load.deepest > 0) return {load.deepest, load.deepest_rate};
  const MotionState motion = system.motion(at.state);
  const Vector3 lowest = lowest_vertex(system.body(), motion);
  return {-system.height(lowest, at.state), -point_velocity(motion, lowest).z()};
}

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

/// An instant within a step, by its ends: the state by Hermite's cubic, rates and forces linearly, so that none exceeds
/// those of the ends.
ContactInstant between(const ContactInstant& a, const ContactInstant& b, double time) {
  const double h = b.time - a.time, x = (time - a.time) / h, rest = 1 - x;
  const auto along = [&](auto&& from, auto&& to) { return rest * from + x * to; };
  ContactInstant at = a;
  at.time = time;
  at.state =
      rest * rest * ((1 + 2 * x) * a.state + x * h * a.rate) + x * x * ((1 + 2 * rest) * b.state - rest * h * b.rate);
  euler_parameters(at.state).normalize();
  at.rate = along(a.rate, b.rate);
  at.diagnosis.load.force = along(a.diagnosis.load.force, b.diagnosis.load.force);
  at.diagnosis.load.energy = along(a.diagnosis.load.energy, b.diagnosis.load.energy);
  at.diagnosis.friction.east = along(a.diagnosis.friction.east, b.diagnosis.friction.east);
  at.diagnosis.friction.north = along(a.diagnosis.friction.north, b.diagnosis.friction.north);
  return at;
}

/// How many times the tolerance the errors of steps keep up, so that a rough run ends too.
constexpr double noise_per_tolerance = 300;

}  // namespace

/// Chooses the length of each step of a contact.  An adaptive method with an error estimate ε of order q, scaled by the
/// tolerance times the contact's scales, repeats steps with ε > 1, and goes on with h × 0.9 ε^(−1/q), within bounds.
class StepControl {
 public:
  explicit StepControl(ContactStep& step) : step_(step) {}

  /// For a contact of these scales, which ends at `evaluation_limit` evaluations of the system.
  void begin(const StepSettings& settings, const ContactScales& scales, long evaluation_limit) {
    assert(scales.depth >= 0 && scales.speed >= 0 && scales.time >= 0);  // each may underflow
    settings_ = settings;
    scales_ = scales;
    evaluation_limit_ = evaluation_limit;
    weigh_errors();
    step_.begin(scales.speed, step_.system().body().radius());
    if (step_.error_order() > 0) {
      fixed_ = 0;
      next_ = settings.step_cap * scales.time / adaptive_first_steps;
    } else {
      fixed_ = settings.step > 0 ? std::min(settings.step, scales.time / fewest_steps)
                                 : scales.time / settings.steps_per_contact;
      next_ = settings.first_step > 0 ? std::min(settings.first_step, fixed_) : fixed_;
    }
  }

  /// Steps from `now` until one is accurate enough and has stepped over no touch; `trial` gets its end.
  /// @return why there is none; nothing where there is one.
  [[nodiscard]] std::optional<ContactEnding> find(const ContactInstant& now, const TouchCounter& touches,
                                                  ContactInstant& trial) {
    step_.choose_method(now, next_);
    const int order = step_.error_order();
    const double horizon = std::max(scales_.time, now.time);
    double h = order > 0 ? std::min(next_, settings_.step_cap * largest_part * horizon) : next_;
    bool is_number = true;  // of the last trial
    for (;;) {
      if (step_.system().evaluations() >= evaluation_limit_) return ContactEnding::evaluation_limit;
      if (!(h > smallest_part * horizon)) {
        return is_number ? ContactEnding::step_too_small : ContactEnding::not_representable;
      }
      is_number = step_.take(now, h, trial);
      if (!is_number) {
        h /= 8;
        continue;
      }
      const double error = order > 0 ? this->error() : 0;
      const double growth = order > 0 ? 0.9 * std::pow(error, -1.0 / order) : 1;
      if (!(error <= 1)) {
        h *= std::clamp(growth, 0.1, 0.7);
      } else if (stepped_over(now, touches, trial) && h > least_over_touches * scales_.time) {
        h /= 2;
      } else {
        assert(trial.time > now.time);
        taken_ = h;
        next_ = order > 0 ? h * std::clamp(growth, 0.2, 4.0) : fixed_;
        return std::nullopt;
      }
    }
  }

  /// Whether the step that was taken last, found or not, is accurate.
  [[nodiscard]] bool is_accurate() const { return step_.error_order() == 0 || error() <= 1; }
  /// Length of the step found last [s].
  [[nodiscard]] double taken() const { return taken_; }
  /// Length of a fixed step [s]; 0: the method is adaptive.
  [[nodiscard]] double fixed() const { return fixed_; }

 private:
  void weigh_errors() {
    const double radius = step_.system().body().radius();
    displacement(weights_).setConstant(scales_.depth);
    euler_parameters(weights_).setConstant(scales_.depth / radius);
    velocity(weights_).setConstant(scales_.speed);
    angular_velocity(weights_).setConstant(scales_.speed / radius);
    works(weights_).setConstant(scales_.energy);
    weights_ *= settings_.tolerance;
  }

  [[nodiscard]] double error() const { return (step_.error().cwiseAbs().cwiseQuotient(weights_)).maxCoeff(); }

  /// A contact shorter than the step, or the gap between two, must not be stepped over.
  [[nodiscard]] bool stepped_over(const ContactInstant& now, const TouchCounter& touches,
                                  const ContactInstant& trial) const {
    const bool shorter = now.time == 0 && !(trial.diagnosis.load.deepest > 0);
    return shorter || touches.all_new(step_.submerged());
  }

  ContactStep& step_;
  StepSettings settings_;
  ContactScales scales_;
  ContactState weights_;  ///< of the components' errors: the error allowed per step
  long evaluation_limit_ = 0;
  double next_ = 0;  ///< length to try next [s]
  double taken_ = 0, fixed_ = 0;
};

/// Events are roots of the numerical solution: the step is repeated with the length that ends on the event.
class EventLocator {
 public:
  explicit EventLocator(ContactStep& step) : step_(step) {}

  /// Events within steps of this tolerance.
  void begin(const ContactScales& scales, double tolerance) {
    scales_ = scales;
    tolerance_ = tolerance;
  }

  /// Length of the step from `now` at whose end `indicator` has just fallen to 0 [s].  `at_root`, given at the end of
  /// the whole step of length h, gets that instant; both stay where the indicator does not fall through 0.
  double fall(const std::function<double(const ContactInstant&)>& indicator, const ContactInstant& now, double h,
              ContactInstant& at_root) {
    const double at_start = indicator(now), at_end = indicator(at_root);
    if (!(at_start > 0 && at_end <= 0)) return h;
    double shortest = h;  // with the indicator at or below 0; at_root has its end
    const auto value = [&](double length) {
      if (length <= 0) return at_start;
      if (!step_.take(now, length, trial_)) return at_end;
      const double found = indicator(trial_);
      if (found <= 0 && length < shortest) {
        shortest = length;
        at_root = trial_;
      }
      return std::isfinite(found) ? found : at_end;
    };
    const double resolution = std::max(1e-14, resolved_part * tolerance_) * (scales_.time + now.time);
    std::uintmax_t iterations = 50;
    const double high =
        boost::math::tools::toms748_solve(
            value, 0.0, h, at_start, at_end, [&](double a, double b) { return b - a <= resolution; }, iterations)
            .second;
    assert(high > 0 && high <= h);
    if (high == shortest || !step_.take(now, high, trial_)) return shortest;
    at_root = trial_;
    return high;
  }

  /// Length of the step from `now`, where F_n > high, at whose end F_n is from `low` to `high` [N]; `at_end` gets that
  /// instant.  Both stay where the search finds none.  For a step at whose end F_n is less than `low`.
  double fade(double low, double high, const ContactInstant& now, double h, ContactInstant& at_end) {
    ContactInstant strong = now;
    double end = h;  // where the force is below `low`
    const double aim = std::sqrt(low * high);
    for (int i = 0; i < 100 && strong.diagnosis.load.force > high; ++i) {
      const double begin = strong.time - now.time, rate = strong.diagnosis.force_rate;
      const double newton = rate < 0 ? begin - (strong.diagnosis.load.force - aim) / rate : begin;
      const double length = newton > begin && newton < end ? newton : (begin + end) / 2;
      if (!(length > begin && length < end) || !step_.take(now, length, trial_)) break;
      if (trial_.diagnosis.load.force > low) {
        strong = trial_;
      } else {
        end = length;
      }
    }
    if (!(strong.time > now.time)) return h;
    at_end = strong;
    return strong.time - now.time;
  }

  /// Length of the step from `now` at whose end the deepest vertex is just out of the ground, by Newton's method in
  /// a bracket; `at_root` as for fall().
  double lift_off(const ContactInstant& now, double h, ContactInstant& at_root) {
    const double resolution = 1e-13 * scales_.depth;
    double low = 0, high = h, length = h, reached = h;
    for (int i = 0; i < 100; ++i) {
      const auto [depth, rate] = deepest_point(step_.system(), at_root);
      if (std::fabs(depth) <= resolution || high - low <= 1e-14 * (scales_.time + now.time)) break;
      (depth > 0 ? low : high) = length;
      const double newton = rate < 0 ? length - depth / rate : low;
      length = newton > low && newton < high ? newton : (low + high) / 2;
      if (!step_.take(now, length, trial_)) break;
      at_root = trial_;
      reached = length;
    }
    return reached;
  }

 private:
  ContactStep& step_;
  ContactScales scales_;
  double tolerance_ = 0;
  ContactInstant trial_;
};

class ForcePeak {
 public:
  explicit ForcePeak(ContactStep& step) : step_(step) {}

  void begin(double force = 0) {
    force_ = force;
    time_ = 0;
  }

  /// Looks for a larger force in the accepted step from `now` to `next`: at its end, and at a maximum of F_n inside it.
  /// The peak of the cubic through the forces and their rates at both ends gives its time, which a secant of the rate
  /// then mends once; the force is that of the numerical solution there, and its error of second order in the time's.
  /// @return the instant of the largest force so far if that lies inside the step, else null.
  [[nodiscard]] const ContactInstant* look(const ContactInstant& now, const ContactInstant& next) {
    note(next);
    const double h = next.time - now.time;
    const StepCubic cubic{h * now.diagnosis.force_rate, h * next.diagnosis.force_rate,
                          next.diagnosis.load.force - now.diagnosis.load.force};
    const double s = place_of_top(cubic);
    if (s == 0) return nullptr;
    const double top = now.diagnosis.load.force + rise_to(cubic, s);
    if (!(top > 0.9 * force_) || !step_.take(now, s * h, trial_)) return nullptr;
    note(trial_);
    inside_ = trial_;
    const double at_trial = h * trial_.diagnosis.force_rate;
    const double other_s = at_trial > 0 ? 1 : 0, other = at_trial > 0 ? cubic.end_slope : cubic.slope;
    const double better = s - at_trial * (other_s - s) / (other - at_trial);
    if (better > 0 && better < 1 && step_.take(now, better * h, trial_)) note(trial_);
    if (trial_.time == time_) inside_ = trial_;
    return inside_.time == time_ ? &inside_ : nullptr;
  }

  [[nodiscard]] double force() const { return force_; }  ///< largest F_n so far [N]
  [[nodiscard]] double time() const { return time_; }    ///< of that, after touch-down [s]

 private:
  void note(const ContactInstant& at) {
    if (!(at.diagnosis.load.force > force_)) return;
    force_ = at.diagnosis.load.force;
    time_ = at.time;
  }

  ContactStep& step_;
  ContactInstant trial_, inside_;
  double force_ = 0, time_ = 0;
};

/// The largest depth of a vertex below the ground.
class DeepestPoint {
 public:
  explicit DeepestPoint(ContactStep& step) : step_(step) {}

  void begin(double depth = 0) { depth_ = depth; }

  /// Looks for a larger depth in the accepted step from `now` to `next`: at its end, and at a maximum inside it, which
  /// the cubic through the depths and their rates at both ends places.  The depth of the numerical solution there is
  /// carried on to the maximum by the parabola of its rate, so that its error is of third order in the time's.
  void look(const ContactInstant& now, const ContactInstant& next) {
    const ContactLoad &from = now.diagnosis.load, &to = next.diagnosis.load;
    depth_ = std::max(depth_, to.deepest);
    const double h = next.time - now.time, begin = std::max(from.deepest, 0.0);
    const StepCubic cubic{h * from.deepest_rate, h * to.deepest_rate, to.deepest - begin};
    const double s = place_of_top(cubic);
    if (s == 0 || !(begin + rise_to(cubic, s) > 0.9 * depth_) || !step_.take(now, s * h, trial_)) return;
    const double depth = trial_.diagnosis.load.deepest, slope = h * trial_.diagnosis.load.deepest_rate;
    // The rate falls along the line from here to the end of the step that lies beyond the maximum.
    const double fall = slope > 0 ? (slope - cubic.end_slope) / (1 - s) : (cubic.slope - slope) / s;
    depth_ = std::max(depth_, fall > 0 ? depth + slope * slope / (2 * fall) : depth);
  }

  [[nodiscard]] double depth() const { return depth_; }  ///< largest δ so far [m]

 private:
  ContactStep& step_;
  ContactInstant trial_;
  double depth_ = 0;
};

class ContactRun::Contact {
 public:
  Contact(ContactSystem& system, Stepper& stepper)
      : system_(system), step_(system, stepper), steps_(step_), events_(step_), peak_(step_), deepest_(step_),
        friction_(system), touches_(system.body()) {}

  [[nodiscard]] ContactResult run(const MotionState& touch, const Vector3& point, const ContactControl& control,
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

 private:
  void begin(const MotionState& touch, const Vector3& point) {
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
  [[nodiscard]] std::optional<ContactEnding> advance() {
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

  [[nodiscard]] std::optional<ContactEnding> ending_on_the_ground() {
    result_.goes_on = motion_on_the_ground(system_, now_, kept_up_speed());
    if (!result_.goes_on) result_.goes_on = rocking_.look(system_, now_);
    if (!result_.goes_on) return std::nullopt;
    const bool rests = result_.goes_on->kind == GroundMotionKind::rests;
    return rests ? ContactEnding::at_rest : ContactEnding::sustained_contact;
  }

  /// If slip ends or stick gives way within the step that led to trial_, moves there and changes the phase.  A step
  /// that ends with hardly a force is judged by the last instant that has one.
  bool handle_friction_event(double h) {
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

  void accept(const ContactInstant& next) {
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

  /// An instant `h` [s] into an accepted step: the end of a shorter step, where that is accurate.  An implicit step
  /// over an unstable slip may not be, however accurate the whole one is: at one length it has a pole.
  [[nodiscard]] bool take_inside(const ContactInstant& next, double h, ContactInstant& at) {
    if (!step_.take(now_, h, at)) return false;
    if (!steps_.is_accurate()) at = between(now_, next, now_.time + h);
    return true;
  }

  /// A step of no length, to an event where the step before it ended, is not shown, nor one of which an instant is no
  /// number.
  void show_step(const ContactInstant& next) {
    const double h = next.time - now_.time;
    if (!(h > 0)) return;
    inside_.resize(shown_->parts.size());
    inside_.front() = now_;
    inside_.back() = next;
    for (std::size_t i = 1; i + 1 < inside_.size(); ++i) {
      if (!take_inside(next, shown_->parts[i] * h, inside_[i])) return;
    }
    shown_->show(inside_);
  }

  void show_times(const ContactInstant& next) {
    const long evaluations = system_.evaluations();
    for (; next_time_ < shown_->times.size() && shown_->times[next_time_] < next.time; ++next_time_) {
      const double h = shown_->times[next_time_] - now_.time;
      const bool is_number = !(h > 0) || take_inside(next, h, aside_);
      shown_->at_time(next_time_, !is_number ? nullptr : h > 0 ? &aside_ : &now_);
    }
    system_.set_aside(system_.evaluations() - evaluations);
  }

  /// Speed that the errors of steps keep up in a body that ought to lie still [m/s].
  [[nodiscard]] double kept_up_speed() const {
    return step_.error_order() > 0 ? noise_per_tolerance * control_->steps.tolerance * result_.scales.speed : 0;
  }

  void collect() {
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

  /// Friction takes what the body moves with along the ground and falls by on its way, the dampers what is left of
  /// other motion and what its tilt sets free at the end.
  void come_to_rest(const GroundMotion& motion) {
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

  ContactSystem& system_;
  ContactStep step_;
  StepControl steps_;
  EventLocator events_;
  ForcePeak peak_;
  DeepestPoint deepest_;
  FrictionPhases friction_;
  TouchCounter touches_;
  RockingWatch rocking_;
  LocalSlipEstimate local_slip_;

  const ContactControl* control_ = nullptr;    ///< of the present run
  const ContactObserver* observer_ = nullptr;  ///< of the present run
  const StepObserver* shown_ = nullptr;        ///< of the present run
  std::vector<ContactInstant> inside_;         ///< of the step that is shown
  std::size_t next_time_ = 0;                  ///< of those that are shown
  ContactInstant now_, trial_, faint_, aside_;
  int switches_ = 0;  ///< of friction since the last step without one
  ContactResult result_;
};

ContactRun::ContactRun(ContactSystem& system, Stepper& stepper)
    : contact_(std::make_unique<Contact>(system, stepper)) {}
ContactRun::~ContactRun() = default;

ContactResult ContactRun::run(const MotionState& touch, const Vector3& point, const ContactControl& control,
                              const ContactObserver& observe, const StepObserver& steps) {
  return contact_->run(touch, point, control, observe, steps);
}

}  // namespace clatter::numeric
