// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/friction_phases.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace clatter::numeric {

namespace {

using Kind = FrictionPhase::Kind;

constexpr double minor_part = 1e-6;             ///< of energy or time: a phase below it does not name the mode
constexpr double minor_part_of_impulse = 0.01;  ///< slip without work, by μ_k = 0, counts from this part on
constexpr std::size_t most_entries = 64;

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

constexpr double enough = 1e-9;  ///< of the bound of friction: a difference of the laws that needs no solving
constexpr double parts_per_range = 4, most_parts = 32;  ///< of a step
constexpr int sweeps = 2, most_trials = 12;
constexpr double near = 0.05;  ///< relative, of the deviation

/// A place where a rising function is at most `small`, searched from `start` in steps that begin with `reach`.
double zero_of(auto&& function, double start, double reach, double small) {
  const double at_start = function(start);
  if (std::fabs(at_start) <= small) return start;
  double inner = start, outer = start, at_inner = at_start, at_outer = at_start;
  for (double step = reach; (at_outer > 0) == (at_start > 0); step *= 4) {
    if (!(step < 1e6 * reach)) return start;
    inner = outer;
    at_inner = at_outer;
    outer = start + (at_start > 0 ? -step : step);
    at_outer = function(outer);
  }
  for (int i = 0; i < most_trials && std::fabs(outer - inner) > near * (std::fabs(outer) + std::fabs(inner)); ++i) {
    double next = i % 3 == 2 ? (inner + outer) / 2 : inner - at_inner * (outer - inner) / (at_outer - at_inner);
    if (!(next > std::min(inner, outer) && next < std::max(inner, outer))) next = (inner + outer) / 2;
    const double value = function(next);
    if (std::fabs(value) <= small) return next;
    ((value > 0) == (at_inner > 0) ? inner : outer) = next;
    ((value > 0) == (at_inner > 0) ? at_inner : at_outer) = value;
  }
  return std::fabs(at_inner) < std::fabs(at_outer) ? inner : outer;
}

/// The slip at which the misfit is small, one component after the other; `reach` is how far a component may go.
AlongGround without_misfit(const auto& misfit, AlongGround slip, const AlongGround& reach, double small, bool planar) {
  for (int sweep = 0; sweep < (planar ? 1 : sweeps); ++sweep) {
    slip.east = zero_of([&](double east) { return misfit({east, slip.north}).east; }, slip.east, reach.east, small);
    if (planar) continue;
    slip.north = zero_of(
        [&](double north) {
          return misfit({slip.east, north}).north;
        },
        slip.north, reach.north, small);
  }
  return slip;
}

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
  if (!from_rest_) return start(Kind::slip, direction_of(slip, 1), now);
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

void LocalSlipEstimate::begin(double least) {
  assert(least >= 0);
  least_ = least;
  slip_ = impulse_ = {};
  last_ = {std::numeric_limits<double>::quiet_NaN(), 0};
}

void LocalSlipEstimate::advance(ContactSystem& system, const ContactState& y, const ContactDiagnosis& at, double h) {
  const AlongGround from = std::isfinite(last_.east) ? last_ : at.slip, to = at.slip;
  last_ = to;
  assert(h >= 0);
  if (!(at.load.force > 0 && h > 0)) return;
  range_ = system.slip_per_depth(y) * at.load.deepest;
  spin_ = system.phase().varies || system.planar() ? 0 : 2 * system.body().radius() * std::fabs(at.spin);
  const AlongGround back{from.east - to.east, from.north - to.north};
  const double square = back.dot(back), nearest = square > 0 ? std::clamp(-to.dot(back) / square, 0.0, 1.0) : 0;
  const AlongGround middle{to.east + nearest * back.east, to.north + nearest * back.north};
  const double bound = system.ground().sliding_friction * at.load.force;
  if (!may_differ(bound, from) && !may_differ(bound, middle) && !may_differ(bound, to) && !(at.hold.norm() > 0)) return;
  const ContactPatch patch = system.patch(y);
  // Friction passes through its range in a part of the step: at its end the slip may just have come to rest.
  const double slowest = std::min(from.norm(), to.norm()) + system.slip_range(patch).width();
  const double parts = std::clamp(std::ceil(parts_per_range * back.norm() / slowest), 1.0, most_parts);
  for (double part = parts - 1; part >= 0; --part) part_of_step(system, patch, at, h / parts, back * (part / parts));
}

/// Equation (2) of the header; true where it does not hold.
bool LocalSlipEstimate::may_differ(double bound, const AlongGround& slip) const {
  const double speed = slip.norm(), range = range_.norm() + slip_.norm() + spin_;
  if (!(speed > 2 * range)) return true;
  const auto across = [&](const AlongGround& v) {
    return std::fabs(v.east * slip.north - v.north * slip.east) / speed;
  };
  return !(2 * bound * (across(range_) + across(slip_) + spin_) <= least_ * speed);
}

void LocalSlipEstimate::part_of_step(ContactSystem& system, const ContactPatch& patch, const ContactDiagnosis& at,
                                     double h, const AlongGround& ahead) {
  const AlongGround here{at.slip.east + ahead.east, at.slip.north + ahead.north};
  const bool slips = !(at.hold.norm() > 0);
  if (slips && !may_differ(system.ground().sliding_friction * at.load.force, here)) return;
  const double bound = system.ground().static_friction * at.load.force;
  const AlongGround by_east = system.response(patch, AlongGround{1, 0});
  const AlongGround by_north = system.response(patch, AlongGround{0, 1});
  const double determinant = by_east.east * by_north.north - by_east.north * by_north.east;
  const bool planar = system.planar();
  const auto impulse_for = [&](const AlongGround& change) {
    if (planar) return AlongGround{change.east / by_east.east, 0};
    return AlongGround{(by_north.north * change.east - by_north.east * change.north) / determinant,
                       (by_east.east * change.north - by_east.north * change.east) / determinant};
  };
  // Coulomb's friction turns with the slip; in stick it is what holds.
  AlongGround coulomb = at.friction;
  if (slips && here.norm() > 0) coulomb = here * (-at.friction.norm() / here.norm());
  AlongGround needed;  // impulse of the difference of the laws that takes the slip to the last trial
  const auto misfit = [&](const AlongGround& slip) -> AlongGround {
    const LocalFriction local = system.local_friction(patch, {slip.east + ahead.east, slip.north + ahead.north});
    const AlongGround turned = system.response(patch, Vector3(h * (local.couple - at.couple)));
    needed = impulse_for({slip.east - slip_.east - turned.east, slip.north - slip_.north - turned.north});
    return {needed.east - h * (local.force.east - coulomb.east),
            needed.north - h * (local.force.north - coulomb.north)};
  };
  AlongGround slip = slip_;
  const double small = h * std::max(enough * bound, least_);
  if (!(misfit(slip).norm() <= small)) {
    slip = without_misfit(misfit, slip, {by_east.east * h * bound, by_north.north * h * bound}, small, planar);
    static_cast<void>(misfit(slip));
  }
  slip_ = slip;
  impulse_.east += needed.east;
  impulse_.north += needed.north;
}

}  // namespace clatter::numeric
