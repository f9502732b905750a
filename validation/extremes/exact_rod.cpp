// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/extremes/exact_rod.hpp"

#include <algorithm>
#include <cmath>

#include "validation/oracles/digits.hpp"
#include "validation/oracles/impulse_path.hpp"
#include "validation/oracles/rod.hpp"

namespace clatter::validation::inline extremes {
namespace {

using oracle::End;
using oracle::Parameter;
using Digits50 = oracle::Digits50;
using D = oracle::Dual<Digits50>;

oracle::RodCase<Digits50> exact(const RodStart& start) {
  return {.theta = oracle::radians(Digits50(start.angle_deg)),
          .gravity_number = start.parameters.gravity_number,
          .restitution = start.parameters.restitution,
          .impulse_ratio = start.parameters.impulse_ratio};
}

/// The root next to `t` on the falling side: by bisection up to the turning point where it lies close (a graze), by
/// Newton's method elsewhere.
Digits50 arrival(const oracle::RodFlight<Digits50>& rod, End end, Digits50 t) {
  const auto bend = [&](const Digits50& at) {
    return Digits50(-rod.gravity - Digits50(0.5) * static_cast<int>(end) * rod.angular * rod.angular *
                                       sin(rod.inclination - rod.angular * at));
  };
  Digits50 low_point = t;
  for (int i = 0; i < 60 && bend(low_point) > 0; ++i) low_point -= end_velocity(rod, end, low_point) / bend(low_point);
  Digits50 before = t * (1 - Digits50(1e-4));
  if (abs(low_point - t) < Digits50(1e-3) * t && end_height(rod, end, before) > 0 &&
      end_height(rod, end, low_point) <= 0) {
    Digits50 after = low_point;
    for (int i = 0; i < 160; ++i) {
      const Digits50 middle = (before + after) / 2;
      (end_height(rod, end, middle) > 0 ? before : after) = middle;
    }
    return after;
  }
  Digits50 step = t;
  for (int i = 0; i < 60 && abs(step) > Digits50(1e-48) * t; ++i) {
    step = end_height(rod, end, t) / end_velocity(rod, end, t);
    t -= step;
  }
  return t;
}

/// The impacts with their derivatives with respect to one parameter.
struct TrueImpacts {
  int count = 0;
  D angle[3], time[3], impulse[3], velocity[3], angular[3];
  Digits50 turning[3]{};  ///< sum of the magnitudes of the terms of `angular`, where friction and reaction cancel
  oracle::RodFlight<Digits50> last{};
};

/// @param found gives the number of impacts and where to look for them
TrueImpacts solve(const oracle::RodCase<Digits50>& rod, const RodImpacts& found, Parameter parameter) {
  TrueImpacts out;
  out.count = found.count;
  oracle::RodMotion<Digits50> motion(rod, parameter);
  End end = End::a;
  Digits50 turning = 0;
  for (int i = 0; i < found.count; ++i) {
    if (i > 0) {
      end = other(end);
      out.time[i] = motion.fly(end, arrival(motion.values(), end, found.time[i]));
    }
    const D inclination = motion.flight().inclination;
    out.angle[i] = inclination.value < 0 ? -inclination : inclination;
    out.impulse[i] = motion.strike(end);
    out.velocity[i] = motion.flight().normal;
    out.angular[i] = motion.flight().angular;
    turning += 6 * out.impulse[i].value * (cos(inclination.value) + abs(rod.impulse_ratio * sin(inclination.value)));
    out.turning[i] = std::max(turning, Digits50(1e-30));  // at 90° the digits of π leave 1e-50 of a cosine that is 0
  }
  out.last = motion.values();
  return out;
}

/// visit(number found, the true one, the size that its error is relative to)
template <class Visit>
void for_each_number(const RodImpacts& found, const TrueImpacts& truth, const Visit& visit) {
  const Digits50 speed = std::max(Digits50(1), Digits50(abs(truth.velocity[0].value)));
  for (int i = 0; i < truth.count; ++i) {
    if (i > 0) {
      visit(found.angle[i], truth.angle[i], truth.angle[i].value);
      visit(found.time[i], truth.time[i], truth.time[i].value);
    }
    visit(found.impulse[i], truth.impulse[i], Digits50(abs(truth.impulse[i].value)));
    visit(found.velocity[i], truth.velocity[i], speed);
    visit(found.angular[i], truth.angular[i], truth.turning[i]);
  }
}

double error(const RodImpacts& found, const TrueImpacts& truth) {
  double worst = 0;
  for_each_number(found, truth, [&](double value, const D& true_value, const Digits50& size) {
    const double off = static_cast<double>(abs(value - true_value.value) / size);
    if (!(off <= worst)) worst = off;
  });
  return worst;
}

double condition(const oracle::RodCase<Digits50>& rod, const RodImpacts& found) {
  double sum = 0;
  for (const Parameter parameter :
       {Parameter::theta, Parameter::gravity_number, Parameter::restitution, Parameter::impulse_ratio}) {
    const Digits50 value = value_of(rod, parameter);
    if (value == 0) continue;
    double worst = 0;
    for_each_number(found, solve(rod, found, parameter), [&](double, const D& true_value, const Digits50& size) {
      worst = std::max(worst, static_cast<double>(abs(value * true_value.slope) / size));
    });
    sum += worst;
  }
  return sum;
}

/// Whether the other end stays above the ground at its first turning point.
bool misses(const TrueImpacts& truth) {
  const Digits50 rounding = 64 * 0x1p-52;
  const oracle::RodFlight<Digits50>& rod = truth.last;
  const Digits50 lowest = turning_heights(rod, truth.count == 2 ? End::b : End::a).far;
  const Digits50 size = rod.centre + abs(rod.normal / rod.angular);
  return lowest > -rounding * size;
}

}  // namespace

RodImpacts rod_impacts(const analytic::ContactAngles& angles) {
  RodImpacts out{.count = angles.impacts()};
  out.angle[0] = angles.theta.radians;
  out.angle[1] = angles.beta.angle;
  out.angle[2] = angles.gamma.angle;
  out.time[1] = angles.beta.time;
  out.time[2] = angles.gamma.time;
  for (int i = 0; i < out.count; ++i) {
    out.impulse[i] = angles.impulse[i];
    out.velocity[i] = angles.velocity[i];
    out.angular[i] = angles.angular[i];
  }
  return out;
}

RodImpacts rod_impacts(const analytic::Sequence& sequence) {
  RodImpacts out;
  for (const analytic::ImpactRow& row : sequence.rows) {
    const int i = out.count;
    if (i == 3 || row.vertices != (i == 1 ? 2 : 1)) break;
    out.angle[i] = row.contact_angle;
    out.time[i] = row.flight.arrival.time;
    out.impulse[i] = row.impact.normal_impulse;
    out.velocity[i] = row.impact.after.normal;
    out.angular[i] = row.impact.after.angular;
    ++out.count;
  }
  return out;
}

RodError rod_error(const RodStart& start, const RodImpacts& impacts) {
  const oracle::RodCase<Digits50> rod = exact(start);
  const TrueImpacts truth = solve(rod, impacts, Parameter::theta);
  const analytic::RodParameters& p = start.parameters;
  const bool elastic = p.gravity_number == 0 && p.restitution == 1 && p.impulse_ratio == 0;
  return {.error = error(impacts, truth),
          .condition = condition(rod, impacts),
          .ends_rightly = !elastic || impacts.count == 3 || misses(truth)};
}

long double exact_restitution(long double damping_number) {
  return static_cast<long double>(oracle::exact_restitution(Digits50(damping_number)));
}

}  // namespace clatter::validation::inline extremes
