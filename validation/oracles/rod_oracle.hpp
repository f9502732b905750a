// SPDX-License-Identifier: GPL-3.0-or-later
// The first three impacts of the thin rod, from the physics alone and at any precision: momentum balances, then free
// flight (rod.hpp), then the first zero of each end's height.
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

#include "validation/oracles/digits.hpp"
#include "validation/oracles/rod.hpp"

namespace clatter::oracle {

/// For angles so small that differences such as γ − θ ~ θ³ and 2 − ΣP ~ θ⁴ use up 50 digits.
using Digits150 = Decimal<150>;

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

/// Solves the first impacts step by step.
template <class Real>
class RodSolver {
 public:
  RodSolver(const RodCase<Real>& rod, Parameter parameter) : motion_(rod, parameter) {
    solution_.parameter = value_of(rod, parameter);
  }

  /// @param impacts after which to stop, 1 to 3
  [[nodiscard]] RodSolution<Real> solve(int impacts) {
    const D theta = motion_.flight().inclination;
    impact(End::a, impulse_1, velocity_1, angular_1);
    if (impacts == 1) return solution_;

    solution_.second = fly(End::a, time_1);
    if (solution_.second != Contact::other_end) return solution_;
    set(beta, -motion_.flight().inclination);
    impact(End::b, impulse_2, velocity_2, angular_2);
    if (impacts == 2) return solution_;

    solution_.third = fly(End::b, time_2);
    if (*solution_.third != Contact::other_end) return solution_;
    const D third = motion_.flight().inclination;
    set(gamma, third);
    set(gamma_minus_theta, third - theta);
    impact(End::a, impulse_3, velocity_3, angular_3);
    set(impulse_deficit, D(Real(2)) - get(impulse_1) - get(impulse_2) - get(impulse_3));
    return solution_;
  }

 private:
  using D = Dual<Real>;

  void set(Quantity q, const D& value) { solution_.quantities[q] = value; }
  [[nodiscard]] const D& get(Quantity q) const { return *solution_.quantities[q]; }

  void impact(End end, Quantity impulse, Quantity velocity, Quantity angular) {
    set(impulse, motion_.strike(end));
    set(velocity, motion_.flight().normal);
    set(angular, motion_.flight().angular);
  }

  /// Flies to the next contact.
  [[nodiscard]] Contact fly(End struck, Quantity time) {
    const auto plain = motion_.values();
    const auto arrival = next_contact<Real>(plain, struck);
    if (arrival.contact == Contact::none) {
      const TurningHeights<Real> heights = turning_heights(plain, struck);
      solution_.clearance = std::min(heights.far, heights.same);
      return Contact::none;
    }
    set(time, motion_.fly(arrival.end, arrival.time));
    return arrival.contact;
  }

  RodMotion<Real> motion_;
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

/// The folds of the elastic rod without gravity or friction, to the last digit of Real but a few.
template <class Real>
Real elastic_fold(Fold fold) {
  const bool second = fold == Fold::second;
  const Bracket<Real> bracket{radians<Real>(second ? 58 : 27), radians<Real>(second ? 59 : 28)};
  return fold_angle<Real>({}, fold, bracket);
}

}  // namespace clatter::oracle
