// The first three impacts of the thin rod, from the physics alone and at any precision: Eq. 8
// solved as the linear system that it is, then free flight, then the first zero of each end's
// height.
//
// The unit rod (m = L = 1) strikes the ground at θ with its left end, v_n = −1, ω = 0.  The first
// zero is isolated by exclusion: an interval is dropped when the bound |h″| <= g + Ω²/2 proves h >
// 0 on it, kept when the bound proves h monotone and its ends differ in sign, and halved otherwise.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tests/analytic/oracle/dual.hpp"

namespace clatter::oracle {

template <unsigned Digits>
using Decimal =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<Digits>, boost::multiprecision::et_off>;
using Digits50 = Decimal<50>;
/// For angles so small that differences such as γ − θ ~ θ³ and 2 − ΣP ~ θ⁴ use up 50 digits.
using Digits150 = Decimal<150>;

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

/// The earliest contact after an impact.
enum class Contact {
  other_end,       ///< the other end, at 90° or less
  beyond_upright,  ///< the other end, after the rod has passed the vertical
  same_end,
  none,
};

enum Quantity : std::size_t {
  beta,
  gamma,
  impulse_1,
  impulse_2,
  impulse_3,
  velocity_1,
  velocity_2,
  velocity_3,
  angular_1,
  angular_2,
  angular_3,
  time_1,
  time_2,
  gamma_minus_theta,
  impulse_deficit,
  quantity_count
};

inline constexpr std::array<const char*, quantity_count> quantity_names = {"beta",
                                                                           "gamma",
                                                                           "P1",
                                                                           "P2",
                                                                           "P3",
                                                                           "V1",
                                                                           "V2",
                                                                           "V3",
                                                                           "Omega1",
                                                                           "Omega2",
                                                                           "Omega3",
                                                                           "T1",
                                                                           "T2",
                                                                           "gamma_minus_theta",
                                                                           "impulse_deficit"};

/// Every quantity of the impacts that happen, with its derivative with respect to one parameter p.
template <class Real>
struct RodSolution {
  Real parameter = 0;  ///< value of p
  Contact second = Contact::none;
  std::optional<Contact> third;  ///< set if second == other_end
  Real clearance = 0;            ///< least height at a turning point of the last flight, if `none`
  std::array<std::optional<Dual<Real>>, quantity_count> quantities;

  /// κ = |p q′(p)/q|.
  [[nodiscard]] Real condition(Quantity q) const {
    using std::abs;
    return abs(parameter * quantities[q]->slope / quantities[q]->value);
  }
};

/// The rod from an impact on; α > 0 means that end a is lower, dα/dt = −Ω.
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

template <class Number>
struct RodImpulse {
  Number normal_impulse;
  RodFlight<Number> after;
};

/// Gaussian elimination with partial pivoting on the values.
template <class Real>
std::array<Dual<Real>, 4> solve_linear(std::array<std::array<Dual<Real>, 5>, 4> rows) {
  using std::abs;
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i)
      if (abs(rows[i][k].value) > abs(rows[pivot][k].value)) pivot = i;
    std::swap(rows[k], rows[pivot]);
    for (std::size_t i = k + 1; i < 4; ++i) {
      const Dual<Real> factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < 5; ++j) rows[i][j] = rows[i][j] - factor * rows[k][j];
    }
  }
  std::array<Dual<Real>, 4> x;
  for (std::size_t k = 4; k-- > 0;) {
    Dual<Real> sum = rows[k][4];
    for (std::size_t j = k + 1; j < 4; ++j) sum = sum - rows[k][j] * x[j];
    x[k] = sum / rows[k][k];
  }
  return x;
}

template <class Number>
struct RodLaw {
  Number restitution;
  Number impulse_ratio;
};

/// Eq. 8 in the unknowns V_n, V_t, Ω, P_n, for the velocities in `before` (its time is the impact).
template <class Real>
RodImpulse<Dual<Real>> strike(const RodFlight<Dual<Real>>& before, End end, const RodLaw<Dual<Real>>& law) {
  using D = Dual<Real>;
  const D half(Real(0.5)), zero(Real(0)), one(Real(1));
  const D sign(Real(static_cast<int>(end)));
  const D dt = sign * half * cos(before.inclination);
  const D dn = sign * half * sin(before.inclination);
  const D mu = law.impulse_ratio;
  const D e = law.restitution;
  const D inertia(Real(1) / 12);
  const D approach = before.normal - before.angular * dt;
  const auto x = solve_linear<Real>({{
      {one, zero, zero, -one, before.normal},
      {zero, one, zero, -mu, before.tangential},
      {zero, zero, inertia, dt - mu * dn, inertia * before.angular},
      {one, zero, -dt, zero, -(e * approach)},
  }});
  return {x[3], {before.inclination, x[0], x[1], x[2], before.gravity, -dn}};
}

/// An interval that holds exactly one zero of an end's height.
template <class Real>
struct Bracket {
  Real low = 0;
  Real high = 0;
};

/// Rounding was about to decide between contact and none at this precision.
class Undecided : public std::runtime_error {
 public:
  Undecided() : std::runtime_error("too little precision to decide about a contact") {}
};

/// First zero of one end's height, by exclusion.
template <class Real>
class FirstZero {
 public:
  FirstZero(const RodFlight<Real>& flight, End end)
      : flight_(flight), end_(end), bend_(flight.gravity + flight.angular * flight.angular / 2) {}

  /// @param from a time at which the end is above the ground
  /// @param until no zero is looked for after this time, if given
  [[nodiscard]] std::optional<Bracket<Real>> search(Real from, std::optional<Real> until) const {
    Real length = first_length();
    for (int segment = 0; segment < most_segments; ++segment) {
      if ((until && from >= *until) || lifted_for_good(from)) return std::nullopt;
      from = std::max(from, Real(fall_time(from) * (1 - jump_reserve)));
      const Real to = from + length;
      if (const auto found = search_interval({from, to}, 0)) return found;
      from = to;
      length = std::min(Real(2 * length), longest());
    }
    throw std::runtime_error("the flight does not end");
  }

 private:
  static constexpr int most_segments = 1'000'000;
  /// An interval halved this often that is still neither clear nor monotone hides a double zero.
  static constexpr int most_halvings = 400;
  static constexpr double jump_reserve = 1e-6;
  /// Keeps the interval ends off the simple fractions of θ at which small angles have their zeros.
  static constexpr double length_factor = 0.618;
  static constexpr int noise_ulps = 64;

  [[nodiscard]] Real first_length() const {
    using std::abs;
    using std::sqrt;
    return length_factor * flight_.centre / (abs(flight_.normal) + abs(flight_.angular) + sqrt(flight_.gravity));
  }
  [[nodiscard]] Real longest() const {
    using std::abs;
    return 1 / (abs(flight_.angular) + sqrt(flight_.gravity));
  }
  [[nodiscard]] Real centre(const Real& t) const {
    return flight_.centre + t * (flight_.normal - flight_.gravity * t / 2);
  }
  [[nodiscard]] bool lifted_for_good(const Real& t) const {
    return flight_.gravity == 0 && flight_.normal >= 0 && centre(t) > 0.5;
  }
  /// While the centre of mass is above half a length no end can touch; the time at which that ends.
  [[nodiscard]] Real fall_time(const Real& t) const {
    using std::sqrt;
    if (flight_.gravity == 0 || !(centre(t) > 0.5)) return 0;
    const Real g = flight_.gravity;
    const Real v = flight_.normal;
    return (v + sqrt(v * v + 2 * g * (flight_.centre - Real(0.5)))) / g;
  }
  [[nodiscard]] Real noise(const Real& t) const {
    using std::abs;
    const Real scale = flight_.centre + abs(flight_.normal) * t + flight_.gravity * t * t + abs(flight_.inclination) +
                       abs(flight_.angular) * t;
    return noise_ulps * std::numeric_limits<Real>::epsilon() * scale;
  }

  [[nodiscard]] std::optional<Bracket<Real>> search_interval(const Bracket<Real>& interval, int halvings) const {
    using std::abs;
    const Real middle = (interval.low + interval.high) / 2;
    const Real radius = (interval.high - interval.low) / 2;
    const Real error = noise(interval.high);
    const Real h = end_height(flight_, end_, middle);
    const Real slope = abs(end_velocity(flight_, end_, middle));
    if (h - (slope + bend_ * radius / 2) * radius > error) return std::nullopt;
    if (slope > 2 * bend_ * radius) return decide_monotone(interval, error);
    if (halvings > most_halvings) throw Undecided();
    if (const auto found = search_interval({interval.low, middle}, halvings + 1)) return found;
    return search_interval({middle, interval.high}, halvings + 1);
  }

  [[nodiscard]] std::optional<Bracket<Real>> decide_monotone(const Bracket<Real>& interval, const Real& error) const {
    const Real low = end_height(flight_, end_, interval.low);
    const Real high = end_height(flight_, end_, interval.high);
    if (low > error && high > error) return std::nullopt;
    if (low > error && high < -error) return interval;
    throw Undecided();
  }

  RodFlight<Real> flight_;
  End end_;
  Real bend_;  ///< bound of |h″|
};

template <class To, class From>
RodFlight<To> convert(const RodFlight<From>& f) {
  return {static_cast<To>(f.inclination), static_cast<To>(f.normal),  static_cast<To>(f.tangential),
          static_cast<To>(f.angular),     static_cast<To>(f.gravity), static_cast<To>(f.centre)};
}

template <class Real>
RodFlight<Real> values(const RodFlight<Dual<Real>>& f) {
  return {f.inclination.value, f.normal.value, f.tangential.value, f.angular.value, f.gravity.value, f.centre.value};
}

/// Plain bisection of an end's height, down to neighbouring numbers.
template <class Real>
Real bisect(const RodFlight<Real>& flight, End end, Bracket<Real> bracket) {
  for (;;) {
    const Real middle = (bracket.low + bracket.high) / 2;
    if (!(middle > bracket.low && middle < bracket.high)) return middle;
    (end_height(flight, end, middle) > 0 ? bracket.low : bracket.high) = middle;
  }
}

/// The zero in a bracket: Newton's method from `start`, trusted only if the height changes sign
/// within a relative distance of ε^0.8 around it; otherwise bisection.
template <class Real>
Real polish(const RodFlight<Real>& flight, End end, const Bracket<Real>& bracket, const Real& start) {
  using std::abs;
  using std::pow;
  static const Real width = pow(std::numeric_limits<Real>::epsilon(), Real(0.8));
  constexpr int most_steps = 60;
  Real t = start;
  Real step = t;
  for (int i = 0; i < most_steps && abs(step) > width * t; ++i) {
    step = end_height(flight, end, t) / end_velocity(flight, end, t);
    t -= step;
  }
  const Real before = t * (1 - width);
  const Real after = t * (1 + width);
  const bool certain = before > bracket.low && after < bracket.high && end_height(flight, end, before) > 0 &&
                       end_height(flight, end, after) < 0;
  return certain ? t : bisect(flight, end, bracket);
}

/// A time at which an end that has just struck is certainly above the ground: it leaves at a speed
/// w and h >= w t − (g + Ω²/2) t²/2.
template <class Real>
Real departure_time(const RodFlight<Real>& flight, End end) {
  return end_velocity(flight, end, Real(0)) / (flight.gravity + flight.angular * flight.angular / 2);
}

/// First zero of an end's height after t = 0, in full precision.  It is isolated in long double
/// where that can decide, in Real where it cannot.
template <class Real>
std::optional<Real> first_contact_of(const RodFlight<Real>& flight, End end, bool touching,
                                     const std::optional<Real>& until) {
  const Real from = touching ? departure_time(flight, end) : Real(0);
  try {
    const auto coarse = convert<long double>(flight);
    std::optional<long double> limit;
    if (until) limit = static_cast<long double>(*until) * (1 + 1e-9L);
    const auto found = FirstZero<long double>(coarse, end).search(static_cast<long double>(from), limit);
    if (!found) return std::nullopt;
    const Bracket<Real> bracket{Real(found->low), Real(found->high)};
    return polish(flight, end, bracket, Real(bisect(coarse, end, *found)));
  } catch (const Undecided&) {
    const auto found = FirstZero<Real>(flight, end).search(from, until);
    if (!found) return std::nullopt;
    return bisect(flight, end, *found);
  }
}

template <class Real>
struct Arrival {
  Contact contact = Contact::none;
  End end = End::a;
  Real time = 0;
};

/// The earliest contact after an impact of `struck`.
template <class Real>
Arrival<Real> next_contact(const RodFlight<Real>& flight, End struck) {
  using std::abs;
  const std::optional<Real> unlimited;
  const auto far = first_contact_of(flight, other(struck), false, unlimited);
  const auto same = first_contact_of(flight, struck, true, far);
  if (same && (!far || *same < *far)) return {Contact::same_end, struck, *same};
  if (!far) return {};
  static const Real right_angle = boost::math::constants::half_pi<Real>();
  const bool upright_passed = abs(flight.inclination - flight.angular * *far) > right_angle;
  return {upright_passed ? Contact::beyond_upright : Contact::other_end, other(struck), *far};
}

/// Without gravity: least height at a turning point of an end, infinite if there is none.  The
/// first turning point is the lowest if the centre of mass does not fall.
template <class Real>
Real lowest_turning_height(const RodFlight<Real>& flight, End struck) {
  using std::abs;
  using std::acos;
  const Real pi = boost::math::constants::pi<Real>();
  const Real speed = abs(flight.angular);
  const Real ratio = 2 * flight.normal / speed;
  if (!(abs(ratio) < 1)) return std::numeric_limits<Real>::infinity();
  // Angles turned until h′ = 0 with h″ > 0, from the inclination that the struck end has.
  const Real start = abs(flight.inclination);
  const bool towards_flat = (flight.angular > 0) == (struck == End::a);
  const Real far_turn = towards_flat ? start + acos(ratio) : 2 * pi - start - acos(-ratio);
  const Real same_turn = far_turn + pi;
  const Real far = end_height(flight, other(struck), Real(far_turn / speed));
  const Real same = end_height(flight, struck, Real(same_turn / speed));
  return std::min(far, same);
}

/// Solves the first impacts step by step.
template <class Real>
class RodSolver {
 public:
  RodSolver(const RodCase<Real>& rod, Parameter parameter) : rod_(rod), parameter_(parameter) {}

  /// @param impacts after which to stop, 1 to 3
  [[nodiscard]] RodSolution<Real> solve(int impacts) {
    solution_.parameter = value_of(rod_, parameter_);
    const D theta = seeded(Parameter::theta);
    law_ = {seeded(Parameter::restitution), seeded(Parameter::impulse_ratio)};
    flight_ = {theta, D(Real(-1)), D(Real(0)), D(Real(0)), seeded(Parameter::gravity_number), D(Real(0))};
    impact(End::a, impulse_1, velocity_1, angular_1);
    if (impacts == 1) return solution_;

    solution_.second = fly(End::a, time_1);
    if (solution_.second != Contact::other_end) return solution_;
    set(beta, -flight_.inclination);
    impact(End::b, impulse_2, velocity_2, angular_2);
    if (impacts == 2) return solution_;

    solution_.third = fly(End::b, time_2);
    if (*solution_.third != Contact::other_end) return solution_;
    set(gamma, flight_.inclination);
    set(gamma_minus_theta, flight_.inclination - theta);
    impact(End::a, impulse_3, velocity_3, angular_3);
    set(impulse_deficit, D(Real(2)) - get(impulse_1) - get(impulse_2) - get(impulse_3));
    return solution_;
  }

 private:
  using D = Dual<Real>;

  [[nodiscard]] D seeded(Parameter parameter) const {
    return D(value_of(rod_, parameter), Real(parameter == parameter_ ? 1 : 0));
  }
  void set(Quantity q, const D& value) { solution_.quantities[q] = value; }
  [[nodiscard]] const D& get(Quantity q) const { return *solution_.quantities[q]; }

  void impact(End end, Quantity impulse, Quantity velocity, Quantity angular) {
    const auto result = strike<Real>(flight_, end, law_);
    flight_ = result.after;
    set(impulse, result.normal_impulse);
    set(velocity, flight_.normal);
    set(angular, flight_.angular);
  }

  /// Flies to the next contact; the derivative of its time follows from h(T(p), p) = 0.
  [[nodiscard]] Contact fly(End struck, Quantity time) {
    const auto plain = values<Real>(flight_);
    const auto arrival = next_contact<Real>(plain, struck);
    if (arrival.contact == Contact::none) {
      solution_.clearance = lowest_turning_height<Real>(plain, struck);
      return Contact::none;
    }
    const D moment(arrival.time);
    const D height = end_height<D>(flight_, arrival.end, moment);
    const D t(arrival.time, -height.slope / end_velocity<Real>(plain, arrival.end, arrival.time));
    set(time, t);
    flight_.inclination = flight_.inclination - flight_.angular * t;
    flight_.normal = flight_.normal - flight_.gravity * t;
    return arrival.contact;
  }

  RodCase<Real> rod_;
  Parameter parameter_;
  RodLaw<D> law_;
  RodFlight<D> flight_;
  RodSolution<Real> solution_;
};

/// @param impacts after which to stop
template <class Real>
RodSolution<Real> solve_rod(const RodCase<Real>& rod, int impacts = 3, Parameter parameter = Parameter::theta) {
  return RodSolver<Real>(rod, parameter).solve(impacts);
}

/// θ → 0: every quantity is q ~ C θ^p (1 + O(θ)) with a whole number p.  C and p are read off at
/// 1e-30 in 150 digits, which leaves 30 correct digits of 2 − ΣP ~ θ⁴; good to 20 digits below
/// 1e-20.
class SmallAngleLaw {
 public:
  static constexpr double validity = 1e-20;  ///< largest θ [rad]

  explicit SmallAngleLaw(RodCase<Digits150> rod) {
    rod.theta = Digits150("1e-30");
    reference_ = solve_rod(rod);
  }

  [[nodiscard]] RodSolution<Digits150> at(const Digits150& theta) const {
    RodSolution<Digits150> result = reference_;
    result.parameter = theta;
    const Digits150 ratio = theta / reference_.parameter;
    for (auto& q : result.quantities) {
      if (!q) continue;
      const int power = whole_power(*q);
      q->value *= pow(ratio, power);
      q->slope = power * q->value / theta;
    }
    return result;
  }

 private:
  [[nodiscard]] int whole_power(const Dual<Digits150>& q) const {
    const double power = static_cast<double>(reference_.parameter * q.slope / q.value);
    const double whole = std::round(power);
    if (!(std::abs(power - whole) < 1e-15)) throw std::runtime_error("no power law at small angles");
    return static_cast<int>(whole);
  }

  RodSolution<Digits150> reference_;
};

/// Which impact a fold ends.
enum class Fold { second, third };

/// Without gravity: height of the other end at its first turning point, after the impact before the
/// one that may end there.  It is zero at the fold, negative where the impact happens.
template <class Real>
Real grazing_height(const RodCase<Real>& rod, Fold fold) {
  using std::acos;
  const bool second = fold == Fold::second;
  const auto at = solve_rod(rod, second ? 1 : 2);
  const Real angle = second ? rod.theta : at.quantities[beta]->value;
  const Real normal = at.quantities[second ? velocity_1 : velocity_2]->value;
  const Real angular = at.quantities[second ? angular_1 : angular_2]->value;
  const RodFlight<Real> flight{second ? angle : Real(-angle), normal, Real(0), angular, Real(0), Real(sin(angle) / 2)};
  const Real speed = second ? angular : Real(-angular);
  const Real turned = angle + acos(Real(2 * normal / speed));
  return end_height(flight, second ? End::b : End::a, Real(turned / speed));
}

/// θ at which an end touches with zero speed, by bisection between two angles [rad].  Known for e =
/// 1 without gravity: 58.488442288312° and 27.577809606636°.
template <class Real>
Real fold_angle(RodCase<Real> rod, Fold fold, Bracket<Real> bracket) {
  for (;;) {
    rod.theta = (bracket.low + bracket.high) / 2;
    if (!(rod.theta > bracket.low && rod.theta < bracket.high)) return rod.theta;
    (grazing_height(rod, fold) < 0 ? bracket.low : bracket.high) = rod.theta;
  }
}

template <class Real>
Real radians(const Real& degrees) {
  return degrees * boost::math::constants::pi<Real>() / 180;
}

/// The folds of the elastic rod without gravity or friction, to the last digit of Real but a few.
template <class Real>
Real elastic_fold(Fold fold) {
  const bool second = fold == Fold::second;
  const Bracket<Real> bracket{radians<Real>(second ? 58 : 27), radians<Real>(second ? 59 : 28)};
  return fold_angle<Real>({}, fold, bracket);
}

}  // namespace clatter::oracle
