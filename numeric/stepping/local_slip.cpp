// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/local_slip.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace clatter::numeric::inline stepping {
namespace {

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

/// The slip at which the misfit vanishes, one component after the other; `reach` is how far a component may go.
template <class Misfit>
AlongGround without_misfit(const Misfit& misfit, AlongGround slip, const AlongGround& reach, bool planar) {
  for (int sweep = 0; sweep < (planar ? 1 : sweeps); ++sweep) {
    slip.east = zero_of([&](double east) { return misfit({east, slip.north}).east; }, slip.east, reach.east);
    if (planar) continue;
    slip.north = zero_of([&](double north) { return misfit({slip.east, north}).north; }, slip.north, reach.north);
  }
  return slip;
}

}  // namespace

void LocalSlipEstimate::begin() {
  slip_ = impulse_ = {};
  last_ = {std::numeric_limits<double>::quiet_NaN(), 0};
}

void LocalSlipEstimate::advance(ContactSystem& system, const ContactState& y, const ContactDiagnosis& at, double h) {
  const AlongGround from = std::isfinite(last_.east) ? last_ : at.slip, to = at.slip;
  last_ = to;
  assert(h >= 0);
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
    slip = without_misfit(misfit, slip, {by_east.east * h * bound, by_north.north * h * bound}, planar);
    static_cast<void>(misfit(slip));
  }
  slip_ = slip;
  impulse_.east += needed.east;
  impulse_.north += needed.north;
}

}  // namespace clatter::numeric::inline stepping
