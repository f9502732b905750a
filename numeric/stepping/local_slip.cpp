// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/local_slip.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace clatter::numeric {
namespace {

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
