#include "validation/extremes/exact_rod.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::validation {
namespace {

using Real = long double;
constexpr Real real_pi = std::numbers::pi_v<Real>;

struct Parameters {
  Real sine, cosine, angle, gravity, restitution, ratio;
};

Parameters exact(const RodStart& start) {
  const Real rest = 90 - Real(start.angle_deg), radian = real_pi / 180;
  return {.sine = std::sin(start.angle_deg * radian),
          .cosine = std::sin(rest * radian),  // the cosine near 90° by its complement
          .angle = start.angle_deg * radian,
          .gravity = start.parameters.gravity_number,
          .restitution = start.parameters.restitution,
          .ratio = start.parameters.impulse_ratio};
}

/// The rod between impacts.  `side` is the half-length with the sign of the end that touches: −1/2 for a.
struct RodState {
  Real height, angle, normal, angular;
};

struct RealImpacts {
  int count = 1;
  RodState end = {};  ///< after the last impact
  Real side = 0;      ///< of the end that struck last
  Real angle[3] = {}, time[3] = {}, impulse[3] = {}, velocity[3] = {}, angular[3] = {};
  Real turning[3] = {};  ///< sum of the magnitudes of the terms of `angular`, where friction and reaction cancel
};

/// d = (side cos α, side sin α); P (A − μ B) = −(1+e) u with A = 1 + 12 d_t², B = 12 d_t d_n.
Real strike(RodState& rod, Real side, Real sine, Real cosine, const Parameters& p) {
  const Real along = side * cosine, across = side * sine;
  const Real approach = rod.normal - rod.angular * along;
  const Real impulse = -(1 + p.restitution) * approach / (1 + 12 * along * along - 12 * p.ratio * along * across);
  rod.normal += impulse;
  rod.angular += 12 * impulse * (p.ratio * across - along);
  return impulse;
}

struct Height {
  Real value, rate, curvature;
};
Height height(const RodState& rod, Real side, Real gravity, Real t) {
  const Real angle = rod.angle - rod.angular * t;
  return {rod.height + rod.normal * t - gravity * t * t / 2 + side * std::sin(angle),
          rod.normal - gravity * t - side * rod.angular * std::cos(angle),
          -gravity - side * rod.angular * rod.angular * std::sin(angle)};
}

/// The root next to `t` on the falling side: by bisection up to the turning point where it lies close (a graze), by
/// Newton's method elsewhere.
Real arrival(const RodState& rod, Real side, Real gravity, Real t) {
  Real low_point = t;
  for (int i = 0; i < 60; ++i) {
    const Height h = height(rod, side, gravity, low_point);
    if (!(h.curvature > 0)) break;
    low_point -= h.rate / h.curvature;
  }
  Real before = t * (1 - Real(1e-4));
  if (std::fabs(low_point - t) < Real(1e-3) * t && height(rod, side, gravity, before).value > 0 &&
      height(rod, side, gravity, low_point).value <= 0) {
    Real after = low_point;
    for (int i = 0; i < 80; ++i) {
      const Real middle = (before + after) / 2;
      (height(rod, side, gravity, middle).value > 0 ? before : after) = middle;
    }
    return after;
  }
  for (int i = 0; i < 60; ++i) {
    const Height h = height(rod, side, gravity, t);
    const Real step = h.value / h.rate;
    if (!(std::fabs(step) > Real(1e-19) * t)) break;
    t -= step;
  }
  return t;
}

/// @param found gives the number of impacts and where to look for them
RealImpacts solve(const Parameters& p, const RodImpacts& found) {
  RealImpacts out{.count = found.count};
  Real side = Real(-0.5);
  RodState rod{p.sine / 2, p.angle, -1, 0};
  out.angle[0] = p.angle;
  out.impulse[0] = strike(rod, side, p.sine, p.cosine, p);
  out.turning[0] = 6 * out.impulse[0] * (p.cosine + std::fabs(p.ratio) * p.sine);
  for (int i = 0;; ++i) {
    out.velocity[i] = rod.normal;
    out.angular[i] = rod.angular;
    out.end = rod;
    out.side = side;
    if (i + 1 >= found.count) return out;
    side = -side;
    const Real t = arrival(rod, side, p.gravity, found.time[i + 1]);
    rod.height += rod.normal * t - p.gravity * t * t / 2;
    rod.normal -= p.gravity * t;
    rod.angle -= rod.angular * t;
    out.time[i + 1] = t;
    out.angle[i + 1] = std::fabs(rod.angle);
    const Real sine = std::sin(rod.angle), cosine = std::cos(rod.angle);
    out.impulse[i + 1] = strike(rod, side, sine, cosine, p);
    out.turning[i + 1] = out.turning[i] + 6 * out.impulse[i + 1] * (cosine + std::fabs(p.ratio * sine));
  }
}

/// The other end is lowest where its normal velocity vanishes, cos α = V/(side Ω).
bool misses(const RealImpacts& truth) {
  constexpr Real rounding = 64 * 0x1p-52L;
  const RodState& rod = truth.end;
  const Real side = -truth.side, turning = std::cos(rod.angle) > 0 ? rod.normal / (side * rod.angular) : Real(1);
  if (!(std::fabs(turning) < 1)) return true;
  // The end at +1/2 is below the centre of mass at negative angles.
  const Real lowest = side > 0 ? -std::acos(turning) : std::acos(turning);
  const Real t = (rod.angle - lowest) / rod.angular;
  if (!(t > 0)) return true;  // it turns the other way, its end up
  return height(rod, side, 0, t).value > -rounding * (rod.height + std::fabs(rod.normal * t));
}

template <class Other>
Real distance(const Other& impacts, const RealImpacts& truth) {
  Real worst = 0;
  const auto add = [&](Real value, Real true_value, Real size) {
    const Real off = value == true_value ? 0 : std::fabs(value - true_value) / size;
    if (!(off <= worst)) worst = off;
  };
  const Real speed = std::fmax(Real(1), std::fabs(truth.velocity[0]));
  for (int i = 0; i < truth.count; ++i) {
    if (i > 0) {
      add(impacts.angle[i], truth.angle[i], truth.angle[i]);
      add(impacts.time[i], truth.time[i], truth.time[i]);
    }
    add(impacts.impulse[i], truth.impulse[i], std::fabs(truth.impulse[i]));
    add(impacts.velocity[i], truth.velocity[i], speed);
    add(impacts.angular[i], truth.angular[i], truth.turning[i]);
  }
  return worst;
}

/// Sum over the parameters of the secants for a change far below a double's rounding, so that a fold one ulp away
/// does not come in between.
double condition(const RodStart& start, const RodImpacts& impacts, const RealImpacts& truth) {
  constexpr Real change = 0x1p-55L;
  const Parameters p = exact(start);
  Real sum = 0;
  Parameters flatter = p;
  flatter.angle *= 1 - change;
  flatter.sine -= p.cosine * p.angle * change;  // the change of both is below the curvature's
  flatter.cosine += p.sine * p.angle * change;
  flatter.sine = p.angle < Real(1e-9) ? p.sine * (1 - change) : flatter.sine;
  sum += distance(solve(flatter, impacts), truth) / change;
  for (Real Parameters::*member : {&Parameters::gravity, &Parameters::restitution, &Parameters::ratio}) {
    if (p.*member == 0) continue;
    Parameters other = p;
    other.*member *= 1 - change;
    sum += distance(solve(other, impacts), truth) / change;
  }
  return static_cast<double>(sum);
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
  const RealImpacts truth = solve(exact(start), impacts);
  const analytic::RodParameters& p = start.parameters;
  const bool elastic = p.gravity_number == 0 && p.restitution == 1 && p.impulse_ratio == 0;
  return {.error = static_cast<double>(distance(impacts, truth)),
          .condition = condition(start, impacts, truth),
          .ends_rightly = !elastic || impacts.count == 3 || misses(truth)};
}

}  // namespace clatter::validation
