#include "numeric/stepping/local_slip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/stepping/contact_run.hpp"

namespace clatter::numeric {
namespace {

using Kind = FrictionPhase::Kind;

constexpr double slip_resolution = 100;       ///< times tolerance and the contact's speed: a range of slip that counts
constexpr double least_resolution = 1e-9;     ///< of that speed
constexpr double turning_resolution = 1e-13;  ///< of that speed: a range above it comes from turning, not rounding
constexpr double steps_of_range = 4;          ///< of a fixed length within which friction may cross the range
constexpr double enough = 1e-9;  ///< of the bound of friction: a difference of the laws that needs no solving
constexpr double parts_per_range = 4, most_parts = 32;  ///< of a step
constexpr int sweeps = 2, most_trials = 12;
constexpr double near = 0.05;  ///< relative, of the deviation

/// The zero of a rising function between `low` and `high`, which are widened until they hold it.
template <class Function>
double zero_of(Function&& function, double start, double reach) {
  const double at_start = function(start);
  if (at_start == 0) return start;
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
    if (value == 0) return next;
    ((value > 0) == (at_inner > 0) ? inner : outer) = next;
    ((value > 0) == (at_inner > 0) ? at_inner : at_outer) = value;
  }
  return std::fabs(at_inner) < std::fabs(at_outer) ? inner : outer;
}

}  // namespace

void LocalSlipEstimate::begin() {
  slip_ = impulse_ = {};
  last_ = {std::numeric_limits<double>::quiet_NaN(), 0};
}

void LocalSlipEstimate::advance(ContactSystem& system, const ContactState& y, const ContactDiagnosis& at, double h) {
  const AlongGround from = std::isfinite(last_.east) ? last_ : at.slip, to = at.slip;
  last_ = to;
  if (!(at.load.force > 0 && h > 0)) return;
  // Friction passes through its range in a part of the step: at its end the slip may just have come to rest.
  const AlongGround back{from.east - to.east, from.north - to.north};
  const double slowest = std::min(from.norm(), to.norm()) + system.slip_range(y).width();
  const double parts = std::clamp(std::ceil(parts_per_range * back.norm() / slowest), 1.0, most_parts);
  for (double part = parts - 1; part >= 0; --part) part_of_step(system, y, at, h / parts, back * (part / parts));
}

void LocalSlipEstimate::part_of_step(ContactSystem& system, const ContactState& y, const ContactDiagnosis& at, double h,
                                     const AlongGround& ahead) {
  const double bound = system.ground().static_friction * at.load.force;
  const AlongGround by_east = system.response(y, at.centre, AlongGround{1, 0});
  const AlongGround by_north = system.response(y, at.centre, AlongGround{0, 1});
  const double determinant = by_east.east * by_north.north - by_east.north * by_north.east;
  const bool planar = system.planar();
  const auto impulse_for = [&](const AlongGround& change) {
    if (planar) return AlongGround{change.east / by_east.east, 0};
    return AlongGround{(by_north.north * change.east - by_north.east * change.north) / determinant,
                       (by_east.east * change.north - by_east.north * change.east) / determinant};
  };
  // Coulomb's friction turns with the slip; in stick it is what holds.
  AlongGround coulomb = at.friction;
  const AlongGround here{at.slip.east + ahead.east, at.slip.north + ahead.north};
  if (!(at.hold.norm() > 0) && here.norm() > 0) coulomb = here * (-at.friction.norm() / here.norm());
  AlongGround needed;  // impulse of the difference of the laws that takes the slip to the last trial
  const auto misfit = [&](const AlongGround& slip) -> AlongGround {
    const LocalFriction local = system.local_friction(y, {slip.east + ahead.east, slip.north + ahead.north});
    const AlongGround turned = system.response(y, at.centre, Vector3(h * (local.couple - at.couple)));
    needed = impulse_for({slip.east - slip_.east - turned.east, slip.north - slip_.north - turned.north});
    return {needed.east - h * (local.force.east - coulomb.east),
            needed.north - h * (local.force.north - coulomb.north)};
  };
  AlongGround slip = slip_;
  if (misfit(slip).norm() > enough * h * bound) {
    for (int sweep = 0; sweep < (planar ? 1 : sweeps); ++sweep) {
      slip.east = zero_of(
          [&](double east) {
            return misfit({east, slip.north}).east;
          },
          slip.east, by_east.east * h * bound);
      if (planar) continue;
      slip.north = zero_of(
          [&](double north) {
            return misfit({slip.east, north}).north;
          },
          slip.north, by_north.north * h * bound);
    }
    static_cast<void>(misfit(slip));
  }
  slip_ = slip;
  impulse_.east += needed.east;
  impulse_.north += needed.north;
}

/// Of the local law: between a patch that counts as a point, which can stick, and one whose points slip each for
/// itself.
void ContactRun::watch_local_slip() {
  const Ground& ground = system_.ground();
  if (ground.friction != FrictionLaw::local || !ground.has_friction()) return;
  FrictionPhase phase = system_.phase();
  const double range = system_.slip_range(now_.state).width();
  double resolved = std::max(slip_resolution * control_->tolerance, least_resolution);
  // Within fewer steps of fixed length friction would overshoot from one end of the range to the other.
  if (stepper_.error_order() == 0) resolved += steps_of_range * ground.sliding_friction * result_.step / scales_.time;
  resolved *= scales_.speed;
  phase.turns = range > turning_resolution * scales_.speed;
  phase.floor = resolved;
  if (phase.kind != Kind::local && range > resolved) {
    change_kind(phase, Kind::local, phase.direction);
  } else if (phase.kind == Kind::local && range < resolved / 2) {
    const AlongGround& slip = now_.diagnosis.slip;
    const double speed = slip.norm();
    if (speed > range) change_kind(phase, Kind::slip, slip * (1 / speed));
    else change_kind(phase, Kind::stick, {});
  } else {
    system_.set_phase(phase);
  }
}

void ContactRun::change_kind(const FrictionPhase& from, FrictionPhase::Kind kind, const AlongGround& direction) {
  log_.close(system_.phase(), sums());
  start_phase(kind, direction);
  FrictionPhase phase = system_.phase();
  phase.turns = from.turns;
  phase.floor = from.floor;
  system_.set_phase(phase);
  now_.diagnosis = system_.diagnose(now_.state, now_.rate);
}

}  // namespace clatter::numeric
