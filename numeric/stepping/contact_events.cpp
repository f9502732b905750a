// Events within a contact: peaks of the force, switches of friction, lift-off.
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>

#include "numeric/stepping/contact_run.hpp"

namespace clatter::numeric {
namespace {

using Kind = FrictionPhase::Kind;

constexpr int most_switches = 8;     ///< of friction without a step between them
constexpr double faint_part = 1e-9;  ///< of the contact's mean force: below it friction switches no more

}  // namespace

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
  return force > 0 ? system_.stick_coefficient() * force - at.diagnosis.hold.norm() : 0;
}

/// Where the contact begins and ends, the forces that decide between slip and stick are rounding.
bool ContactRun::is_faint(const ContactInstant& at) const { return !(force_to_judge(at) > 0); }

double ContactRun::force_to_judge(const ContactInstant& at) const {
  return at.diagnosis.load.force - faint_part * scales_.energy / scales_.depth;
}

bool ContactRun::phase_is_over(const ContactInstant& at) const {
  return system_.phase().kind == Kind::slip ? !(slip_forward(at) > 0) : stick_reserve(at) < 0;
}

/// If slip ends or stick gives way within the step that led to trial_, moves there and changes the phase.  A step that
/// ends with hardly a force is judged by the last instant that has one.
bool ContactRun::handle_friction_event(double h) {
  const Kind kind = system_.phase().kind;
  if (kind != Kind::slip && kind != Kind::stick) return false;
  if (is_faint(trial_)) {
    if (is_faint(now_)) return false;
    faint_ = trial_;
    h = locate(&ContactRun::force_to_judge, h, trial_);
    if (!phase_is_over(trial_)) trial_ = faint_;
  }
  if (!phase_is_over(trial_) || ++switches_ > most_switches) return false;
  const int switches = switches_;
  const Indicator indicator = kind == Kind::slip ? &ContactRun::slip_forward : &ContactRun::stick_reserve;
  if ((this->*indicator)(now_) > 0) {
    static_cast<void>(locate(indicator, h, trial_));
    accept(trial_);
  }
  switches_ = switches;
  change_phase();
  return true;
}

/// From slip to stick where that holds, else to slip against what would have held.
void ContactRun::change_phase() {
  const Kind kind = system_.phase().kind;
  log_.close(system_.phase(), sums());
  const AlongGround hold = kind == Kind::stick ? trial_.diagnosis.hold : system_.sticking_force(trial_.state);
  const double normal = trial_.diagnosis.load.force;
  const bool can_hold = kind == Kind::slip && hold.norm() <= system_.stick_coefficient() * normal;
  if (can_hold) {
    start_phase(Kind::stick, {});
  } else {
    const double size = hold.norm();
    start_phase(Kind::slip, size > 0 ? hold * (-1 / size) : system_.phase().direction);
  }
  now_.diagnosis = system_.diagnose(now_.state, now_.rate);
}

/// The length of the step at whose end the indicator has just fallen to 0; at_root, given at h, gets that instant.
double ContactRun::locate(Indicator indicator, double h, ContactInstant& at_root) {
  const double at_start = (this->*indicator)(now_), at_end = (this->*indicator)(at_root);
  if (!(at_start > 0 && at_end <= 0)) return h;
  const auto value = [&](double length) {
    if (length <= 0) return at_start;
    const double found = try_step(now_, length, probe_) ? (this->*indicator)(probe_) : at_end;
    return std::isfinite(found) ? found : at_end;
  };
  const double resolution = 1e-14 * (scales_.time + now_.time);
  std::uintmax_t iterations = 50;
  const double high =
      boost::math::tools::toms748_solve(
          value, 0.0, h, at_start, at_end, [&](double a, double b) { return b - a <= resolution; }, iterations)
          .second;
  if (!try_step(now_, high, probe_)) return h;
  at_root = probe_;
  return high;
}

/// The length of the step at whose end the deepest vertex is just out of the ground, by Newton's method in a
/// bracket; at_root, given at h, gets that instant.
double ContactRun::lift_off_time(double h, ContactInstant& at_root) {
  const double resolution = 1e-13 * scales_.depth;
  double low = 0, high = h, length = h, reached = h;
  for (int i = 0; i < 100; ++i) {
    const double depth = at_root.diagnosis.load.deepest, rate = at_root.diagnosis.load.deepest_rate;
    if (std::fabs(depth) <= resolution || high - low <= 1e-14 * (scales_.time + now_.time)) break;
    (depth > 0 ? low : high) = length;
    const bool seen = depth > -0.5 * system_.body().radius();  // facets far above the ground are not looked at
    const double newton = seen && rate < 0 ? length - depth / rate : low;
    length = newton > low && newton < high ? newton : (low + high) / 2;
    if (!try_step(now_, length, probe_)) break;
    at_root = probe_;
    reached = length;
  }
  return reached;
}

}  // namespace clatter::numeric
