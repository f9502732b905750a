// SPDX-License-Identifier: GPL-3.0-or-later
// The thin rod at and between its impacts, from the balances of momentum and free flight, at any precision.
//
// The unit rod (m = L = 1, I = 1/12) has its ends at d = ±(cos α, sin α)/2 from the centre of mass; α > 0 means that
// end a, at −, is lower; dα/dt = −Ω.  `Number` is Real, or Dual<Real> to carry a derivative, so that
// condition numbers are known at any precision.
#pragma once

#include <boost/math/constants/constants.hpp>

#include <cmath>
#include <limits>

namespace clatter::oracle {

/// A value and its derivative with respect to one parameter.
template <class Real>
struct Dual {
  Real value = 0;
  Real slope = 0;

  Dual() = default;
  Dual(const Real& constant) : value(constant) {}  // NOLINT: constants mix freely with duals
  Dual(const Real& v, const Real& s) : value(v), slope(s) {}

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Real quotient = a.value / b.value;
    return {quotient, (a.slope - quotient * b.slope) / b.value};
  }
  friend Dual sin(const Dual& a) {
    using std::cos;
    using std::sin;
    return {sin(a.value), cos(a.value) * a.slope};
  }
  friend Dual cos(const Dual& a) {
    using std::cos;
    using std::sin;
    return {cos(a.value), -sin(a.value) * a.slope};
  }
};

template <class Real>
struct RodCase {
  Real theta = 0;  ///< [rad]
  Real gravity_number = 0;
  Real restitution = 1;
  Real impulse_ratio = 0;  ///< P_t = μ_i P_n in the world frame
};

/// What derivatives are taken with respect to.
enum class Parameter { theta, gravity_number, restitution, impulse_ratio };

template <class Real>
Real value_of(const RodCase<Real>& rod, Parameter parameter) {
  switch (parameter) {
    case Parameter::theta: return rod.theta;
    case Parameter::gravity_number: return rod.gravity_number;
    case Parameter::restitution: return rod.restitution;
    case Parameter::impulse_ratio: break;
  }
  return rod.impulse_ratio;
}

enum class End : int { a = -1, b = 1 };

inline End other(End end) { return end == End::a ? End::b : End::a; }

/// The rod from an impact on.
template <class Number>
struct RodFlight {
  Number inclination;
  Number normal;      ///< V_n
  Number tangential;  ///< V_t
  Number angular;     ///< Ω
  Number gravity;
  Number centre;  ///< height of the centre of mass at t = 0
};

template <class Number>
Number end_height(const RodFlight<Number>& flight, End end, const Number& t) {
  using std::sin;
  const Number half(0.5);
  const Number sign(static_cast<int>(end));
  return flight.centre + flight.normal * t - half * flight.gravity * t * t +
         sign * half * sin(flight.inclination - flight.angular * t);
}

template <class Number>
Number end_velocity(const RodFlight<Number>& flight, End end, const Number& t) {
  using std::cos;
  const Number half(0.5);
  const Number sign(static_cast<int>(end));
  return flight.normal - flight.gravity * t -
         sign * half * flight.angular * cos(flight.inclination - flight.angular * t);
}

/// Without gravity: height of the other end at its first turning point after an impact of `struck`, infinite if there
/// is none.  `same` gives the height of the struck end at its turning point, half a turn later.
template <class Real>
struct TurningHeights {
  Real far = std::numeric_limits<Real>::infinity(), same = far;
};
template <class Real>
TurningHeights<Real> turning_heights(const RodFlight<Real>& flight, End struck) {
  using std::abs, std::acos;
  const Real pi = boost::math::constants::pi<Real>();
  const Real speed = abs(flight.angular);
  const Real ratio = 2 * flight.normal / speed;
  if (!(abs(ratio) < 1)) return {};
  // Angles turned until h′ = 0 with h″ > 0, from the inclination that the struck end has.
  const Real start = abs(flight.inclination);
  const bool towards_flat = (flight.angular > 0) == (struck == End::a);
  const Real far_turn = towards_flat ? start + acos(ratio) : 2 * pi - start - acos(-ratio);
  return {end_height(flight, other(struck), Real(far_turn / speed)),
          end_height(flight, struck, Real((far_turn + pi) / speed))};
}

/// The rod with the derivative of its motion with respect to one parameter, from impact to impact.
template <class Real>
class RodMotion {
 public:
  using D = Dual<Real>;

  /// About to strike with end a: v_n = −1, v_t = ω = 0.
  RodMotion(const RodCase<Real>& rod, Parameter parameter) {
    const auto seeded = [&](Parameter p) { return D(value_of(rod, p), Real(p == parameter ? 1 : 0)); };
    restitution_ = seeded(Parameter::restitution);
    impulse_ratio_ = seeded(Parameter::impulse_ratio);
    flight_ = {seeded(Parameter::theta), D(Real(-1)), D(Real(0)), D(Real(0)), seeded(Parameter::gravity_number), {}};
  }

  [[nodiscard]] const RodFlight<D>& flight() const { return flight_; }
  [[nodiscard]] RodFlight<Real> values() const {
    const RodFlight<D>& f = flight_;
    return {f.inclination.value, f.normal.value, f.tangential.value, f.angular.value, f.gravity.value, f.centre.value};
  }

  /// Changes the velocities to those after an impact of `end` and returns P_n.  From V_n = v_n + P_n,
  /// V_t = v_t + μ_i P_n, Ω = ω + 12 (μ_i d_n − d_t) P_n and V_n − Ω d_t = −e (v_n − ω d_t):
  ///     P_n [1 + 12 d_t² − 12 μ_i d_t d_n] = −(1 + e) (v_n − ω d_t).
  D strike(End end) {
    const D half(Real(0.5) * static_cast<int>(end)), one(Real(1)), twelve(Real(12));
    const D dt = half * cos(flight_.inclination), dn = half * sin(flight_.inclination);
    const D approach = flight_.normal - flight_.angular * dt;
    const D impulse = -((one + restitution_) * approach) / (one + twelve * dt * (dt - impulse_ratio_ * dn));
    flight_.normal = flight_.normal + impulse;
    flight_.tangential = flight_.tangential + impulse_ratio_ * impulse;
    flight_.angular = flight_.angular + twelve * impulse * (impulse_ratio_ * dn - dt);
    flight_.centre = -dn;
    return impulse;
  }

  /// To the touch of `end` at `time`; returns that time with its derivative, which follows from h(T(p), p) = 0.
  D fly(End end, const Real& time) {
    const D height = end_height<D>(flight_, end, D(time));
    const D t(time, -height.slope / end_velocity<Real>(values(), end, time));
    flight_.inclination = flight_.inclination - flight_.angular * t;
    flight_.normal = flight_.normal - flight_.gravity * t;
    return t;
  }

 private:
  D restitution_, impulse_ratio_;
  RodFlight<D> flight_;
};

}  // namespace clatter::oracle
