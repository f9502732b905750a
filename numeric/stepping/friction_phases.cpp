// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/friction_phases.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace clatter::numeric {
namespace {

using Kind = FrictionPhase::Kind;

constexpr double minor_part = 1e-6;             ///< of energy or time: a phase below it does not name the mode
constexpr double minor_part_of_impulse = 0.01;  ///< slip without work, by μ_k = 0, counts from this part on
constexpr std::size_t most_entries = 64;

}  // namespace

FrictionLog::FrictionLog() { entries_.reserve(most_entries); }

void FrictionLog::begin(const ContactScales& scales, double mass) {
  entries_.clear();
  least_work_ = minor_part * scales.energy;
  least_impulse_ = minor_part_of_impulse * mass * scales.speed;
  least_time_ = minor_part * scales.time;
}

void FrictionLog::close(const FrictionPhase& phase, const Sums& sums) {
  const bool slips = phase.kind == Kind::slip;
  const bool matters = slips ? sums.work - start_.work > least_work_ || sums.impulse - start_.impulse > least_impulse_
                             : sums.time - start_.time > least_time_;
  if (!matters || entries_.size() == most_entries) return;
  const bool goes_on = !entries_.empty() && entries_.back().kind == phase.kind &&
                       !(slips && entries_.back().direction.dot(phase.direction) < 0);
  if (!goes_on) entries_.push_back({phase.kind, phase.direction});
}

FrictionMode FrictionLog::mode() const {
  if (entries_.empty()) return FrictionMode::stick;
  const auto turns_back = [](const Entry& one, const Entry& next) { return one.kind == next.kind; };
  if (std::adjacent_find(entries_.begin(), entries_.end(), turns_back) != entries_.end()) {
    return FrictionMode::reverse_slip;
  }
  const bool slips_first = entries_.front().kind == Kind::slip;
  switch (entries_.size()) {
    case 1: return slips_first ? FrictionMode::slip : FrictionMode::stick;
    case 2: return slips_first ? FrictionMode::slip_stick : FrictionMode::stick_slip;
    case 3: return slips_first ? FrictionMode::slip_stick_slip : FrictionMode::stick_slip_stick;
    default: return FrictionMode::alternating;
  }
}

namespace {

using Kind = FrictionPhase::Kind;

constexpr double direction_rounding = 1e-14;  ///< of its unit length

/// Slip slower than this part, times √tolerance, of the contact's speed keeps its direction: across it friction is a
/// damper that stiffens like 1/|v|, which explicit steps could not follow.  Slip that begins at the touch keeps it less
/// long: how it turns then decides whether it stops.
constexpr double slow_part = 0.1, slow_part_at_onset = 0.01;
constexpr double ended_part = 1e-3;            ///< times √tolerance and the contact's speed: slip that has ended
constexpr double digits_beyond_tolerance = 3;  ///< of friction over a patch: steps see nothing of its error
constexpr double least_spin = 1;               ///< times tolerance and the contact's speed: slip from spin that counts
constexpr double fading_per_contact = 50;      ///< rate at which stick ends a remaining slip, times the contact time
constexpr double faint_part = 1e-9;            ///< of the contact's mean force: below it friction switches no more
constexpr double slip_per_spin = 3;            ///< slip over slip from spin, below which both can end
constexpr double slip_resolution = 100;        ///< times tolerance and the contact's speed: a range of slip that counts
constexpr double least_resolution = 1e-9;      ///< of that speed
constexpr double turning_resolution = 1e-13;   ///< of that speed: a range above it comes from turning, not rounding
constexpr double left_per_held_slip = 10;      ///< what bound (1) errs by over the mean slip from spin in it, as seen
constexpr double steps_of_range = 4;           ///< of a fixed length within which friction may cross the range

/// The unit vector along `v`, or against it with `sign` −1.  The inverse of a length below 1e-308 overflows.
AlongGround direction_of(const AlongGround& v, double sign) {
  const AlongGround scaled = v * (v.norm() < 1e-290 ? 0x1p900 : 1);
  return scaled * (sign / scaled.norm());
}

}  // namespace

void FrictionPhases::begin(const MotionState& touch, const Vector3& point, const ContactScales& scales,
                           const Settings& settings, const ContactInstant& now) {
  settings_ = settings;
  scales_ = scales;
  noted_time_ = held_way_ = 0;
  log_.begin(scales, system_.body().mass());
  const Ground& ground = system_.ground();
  const AlongGround none;
  if (!ground.has_friction()) return start(Kind::none, none, now);
  if (ground.friction == FrictionLaw::regularised) return start(Kind::regularised, none, now);
  const Vector3 moving = touch.velocity + touch.attitude * touch.angular_velocity.cross(point);
  const AlongGround slip{moving.x(), system_.planar() ? 0.0 : moving.y()};
  const double speed = slip.norm();
  from_rest_ = !(speed > 1e-12 * std::max(scales_.speed, touch.velocity.norm()));
  if (!from_rest_) {
    return start(Kind::slip, direction_of(slip, 1), now);
  }
  AlongGround ratio = system_.sticking_ratio(point);
  if (settings_.is_pressed) {
    system_.set_phase({.kind = Kind::none, .direction = {}, .point = !spin_counts()});
    ratio = system_.sticking_force(now.state) * (1 / system_.pressed(0).force);
  }
  if (ratio.norm() <= ground.static_friction) return start(Kind::stick, none, now);
  start(Kind::slip, direction_of(ratio, -1), now);
}

void FrictionPhases::start(Kind kind, const AlongGround& direction, const ContactInstant& now) {
  assert(kind != Kind::slip || std::fabs(direction.norm() - 1) <= direction_rounding);
  log_.open(sums(now));
  FrictionPhase phase{.kind = kind,
                      .direction = direction,
                      .digits = std::clamp(digits_beyond_tolerance - std::log10(settings_.tolerance), 9.0, 15.0),
                      .slow = slow_slip(),
                      .fading = fading_per_contact / scales_.time,
                      .point = !spin_counts()};
  if (kind == Kind::slip && !system_.planar()) note_variation(phase, now);
  has_slipped_ = false;
  system_.set_phase(phase);
}

double FrictionPhases::slow_slip() const {
  return (from_rest_ ? slow_part_at_onset : slow_part) * std::sqrt(settings_.tolerance) * scales_.speed;
}

/// Slip of the patch from spin that is slower can stick [m/s].  Within fewer steps of fixed length friction would
/// overshoot.
double FrictionPhases::slow_spin() const {
  const double by_steps = steps_of_range * system_.ground().sliding_friction * settings_.fixed_step / scales_.time;
  const bool sticks = system_.phase().kind == Kind::stick;
  return (sticks ? slow_part * std::sqrt(settings_.tolerance) * scales_.speed : slow_slip()) + by_steps * scales_.speed;
}

/// Whether the patch spins noticeably.  The faster its farthest point might, the less slip needs a direction from the
/// phase: over the patch it has all of them, and a lean would count as slip.  A lean that ended at once would switch on
/// and off where friction brings the spin back to that speed.
void FrictionPhases::note_variation(FrictionPhase& phase, const ContactInstant& now) const {
  if (!spin_counts()) return;
  const double spin_speed = std::fabs(system_.vertical_spin(now.state)) * system_.body().radius();
  phase.varies = spin_speed > least_spin * settings_.tolerance * scales_.speed;
  phase.slow = std::max(slow_slip() - spin_speed, 0.0);
}

FrictionLog::Sums FrictionPhases::sums(const ContactInstant& now) const {
  const double fall = velocity(now.state).z() - system_.touch_down().velocity.z() + system_.gravity() * now.time;
  return {now.time, friction_work(now.state), system_.body().mass() * fall};
}

bool FrictionPhases::can_end() const {
  const Kind kind = system_.phase().kind;
  return kind == Kind::slip || kind == Kind::stick;
}

double FrictionPhases::slip_forward(const ContactInstant& at) const {
  const ContactDiagnosis& now = at.diagnosis;
  const FrictionPhase& phase = system_.phase();
  if (!(now.load.force > 0) || (!has_slipped_ && phase.varies && phase.slow == 0)) return scales_.speed;
  const double forward = now.slip.dot(phase.direction), spinning = spin_speed(now);
  return has_slipped_ ? std::max(forward - slip_per_spin * spinning, spinning - slow_spin()) : forward;
}

/// Slip of the patch from its spin [m/s].
double FrictionPhases::spin_speed(const ContactDiagnosis& now) const {
  return spin_counts() ? std::fabs(now.spin) * now.patch_radius : 0;
}

double FrictionPhases::stick_reserve(const ContactInstant& at) const {
  const double force = at.diagnosis.load.force;
  if (!(force > 0)) return 0;
  const double bound = system_.stick_coefficient() * force;
  return std::min(bound - at.diagnosis.hold.norm(), bound * (1 - spin_speed(at.diagnosis) / (2 * slow_spin())));
}

double FrictionPhases::reserve(const ContactInstant& at) const {
  assert(can_end());
  return system_.phase().kind == Kind::slip ? slip_forward(at) : stick_reserve(at);
}

double FrictionPhases::faint_force() const { return faint_part * scales_.energy / scales_.depth; }

bool FrictionPhases::is_over(const ContactInstant& at) const {
  return system_.phase().kind == Kind::slip ? !(slip_forward(at) > 0) : stick_reserve(at) < 0;
}

void FrictionPhases::change(const ContactInstant& at, ContactInstant& now) {
  assert(can_end());
  const Kind kind = system_.phase().kind;
  from_rest_ = from_rest_ && kind == Kind::slip;
  log_.close(system_.phase(), sums(now));
  const AlongGround hold = kind == Kind::stick ? at.diagnosis.hold : system_.sticking_force(at.state);
  const double normal = at.diagnosis.load.force;
  const bool can_hold = kind == Kind::slip && hold.norm() <= system_.stick_coefficient() * normal;
  const AlongGround& slip = at.diagnosis.slip;
  // Within the step slip has turned away from its direction, without an end.
  const bool goes_on =
      kind == Kind::slip && slip.norm() > std::max(ended_part * std::sqrt(settings_.tolerance) * scales_.speed,
                                                   slip_per_spin * spin_speed(at.diagnosis));
  if (goes_on) {
    start(Kind::slip, direction_of(slip, 1), now);
  } else if (can_hold) {
    start(Kind::stick, {}, now);
  } else {
    const AlongGround& last = system_.phase().direction;
    const AlongGround any{1, 0};  // a patch that spins without slip
    start(Kind::slip, hold.norm() > 0 ? direction_of(hold, -1) : last.norm() > 0 ? last : any, now);
  }
  now.diagnosis = system_.diagnose(now.state, now.rate);
}

void FrictionPhases::note_held_spin(const ContactInstant& now) {
  const double time = now.time - std::exchange(noted_time_, now.time);
  if (now.diagnosis.spins) held_way_ += spin_speed(now.diagnosis) * time;
}

double FrictionPhases::left_out(double duration) const {
  return duration > 0 ? left_per_held_slip * held_way_ / duration : 0;
}

void FrictionPhases::follow(const ContactInstant& now) {
  note_held_spin(now);
  FrictionPhase phase = system_.phase();
  if (phase.kind != Kind::slip || system_.planar()) return;
  const AlongGround& slip = now.diagnosis.slip;
  // Slip that has hardly begun keeps the direction in which it was let go.
  const AlongGround leaning{slip.east + phase.slow * phase.direction.east,
                            slip.north + phase.slow * phase.direction.north};
  if (now.diagnosis.load.force > 0 && leaning.norm() > 0) phase.direction = direction_of(leaning, 1);
  note_variation(phase, now);
  const double spinning = spin_speed(now.diagnosis);
  has_slipped_ = has_slipped_ || slip.norm() > slip_per_spin * spinning || spinning > slow_spin();
  system_.set_phase(phase);
}

void FrictionPhases::choose_local_slip(ContactInstant& now) {
  const Ground& ground = system_.ground();
  if (ground.friction != FrictionLaw::local || !ground.has_friction()) return;
  FrictionPhase phase = system_.phase();
  const double range = system_.slip_range(system_.patch(now.state)).width();
  double resolved = std::max(slip_resolution * settings_.tolerance, least_resolution);
  // Within fewer steps of fixed length friction would overshoot from one end of the range to the other.
  if (settings_.fixed_step > 0) {
    resolved += steps_of_range * ground.sliding_friction * settings_.fixed_step / scales_.time;
  }
  resolved *= scales_.speed;
  phase.turns = range > turning_resolution * scales_.speed;
  phase.floor = resolved;
  if (phase.kind != Kind::local && range > resolved) {
    change_kind(phase, Kind::local, phase.direction, now);
  } else if (phase.kind == Kind::local && range < resolved / 2) {
    const AlongGround& slip = now.diagnosis.slip;
    const double speed = slip.norm();
    if (speed > range) change_kind(phase, Kind::slip, slip * (1 / speed), now);
    else change_kind(phase, Kind::stick, {}, now);
  } else {
    system_.set_phase(phase);
  }
}

void FrictionPhases::change_kind(const FrictionPhase& from, Kind kind, const AlongGround& direction,
                                 ContactInstant& now) {
  log_.close(system_.phase(), sums(now));
  start(kind, direction, now);
  FrictionPhase phase = system_.phase();
  phase.turns = from.turns;
  phase.floor = from.floor;
  system_.set_phase(phase);
  now.diagnosis = system_.diagnose(now.state, now.rate);
}

FrictionMode FrictionPhases::end(const ContactInstant& now) {
  log_.close(system_.phase(), sums(now));
  const Ground& ground = system_.ground();
  if (!ground.has_friction()) return FrictionMode::frictionless;
  if (ground.friction == FrictionLaw::regularised) return FrictionMode::regularised;
  return ground.friction == FrictionLaw::local ? FrictionMode::local : log_.mode();
}

}  // namespace clatter::numeric
