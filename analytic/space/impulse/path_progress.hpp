// SPDX-License-Identifier: GPL-3.0-or-later
// How far an impact has come along its path in impulse space, and when its restitution law ends it.
//
// Units here: the approach speed v and v/W_nn.  Restitution laws, with u the normal velocity and u = −1 at the start:
//   Newton       ends where u = e first
//   Poisson      ends at p = (1+e) p_c; were u < 0 there, the ground would go on pushing: until u = 0
//   Stronge      ends where E = 0, dE = −u dp, E multiplied by e² at p_c
//   viscoelastic ends where E = 0, dE = −u dp/(1 − τu), E left as it is at p_c (viscoelastic.hpp)
// p_c, the end of compression, is the first impulse at which u = 0.  Where u turns negative again after it (a second
// compression; friction that reverses can do that), E grows again without a second loss, and p_c stays.
#pragma once

#include <array>
#include <limits>
#include <type_traits>

#include "analytic/base/dual.hpp"
#include "analytic/law/impact_law.hpp"
#include "analytic/space/flight/body.hpp"

namespace clatter::analytic::space {

/// What ends compression and restitution.
struct RestitutionRule {
  RestitutionLaw law = RestitutionLaw::newton;
  double restitution = 1;  ///< e
  double damping = 0;      ///< τ v of the viscoelastic law
};

enum class Stage {
  compression,  ///< until u = 0
  restitution,  ///< until the law's condition
  overtime,     ///< Poisson's impulse is spent and the point still approaches: until u = 0
  done,
};

/// A number with its derivatives for turns of the body about x and y and for v_x, v_y, v_z in the unit of velocity.
using PathDual = detail::Dual<5>;

/// What the stages look at, along the path.
template <class Number = double>
struct Measure {
  Number impulse = 0;           ///< p
  Number normal_velocity = -1;  ///< u
  Number store = 0;             ///< E
};

/// Number: double, or PathDual for derivatives; the latter holds those of the approach speed, which is 1.
template <class Number = double>
class PathProgress {
 public:
  PathProgress(const RestitutionRule& rule, const Number& initial_slip, const Number& approach)
      : slip(initial_slip), least_slip(detail::value_of(initial_slip)), rule_(rule), approach_(approach) {
    at.normal_velocity = -approach;
  }

  [[nodiscard]] Stage stage() const { return stage_; }
  [[nodiscard]] bool is_done() const { return stage_ == Stage::done; }
  /// What rises through zero at the end of the stage.
  template <class Value>
  [[nodiscard]] Value excess(const Measure<Value>& at) const;
  /// The derivative of excess() by the impulse, where u has the derivative `normal_rate`.
  [[nodiscard]] double excess_rate(const Measure<>& at, double normal_rate) const;
  /// Impulse to the end of the stage at a constant normal_rate = du/dp; infinite if that does not lead there.
  [[nodiscard]] Number length_of_stage(const Number& normal_rate) const;
  /// Enters the next stage.
  void end_stage();

  /// Goes along a straight line of constant ratio = dP_t/dp and normal_rate = du/dp for the impulse `length` or to the
  /// end of the law, whichever comes first.
  struct Line {
    std::array<Number, 2> ratio{};
    Number normal_rate = 1;
    Number length = std::numeric_limits<double>::infinity();
  };
  void follow(const Line& line);

  /// dE/dp at u.
  [[nodiscard]] double storing(double normal_velocity) const {
    return -normal_velocity / (1 - rule_.damping * normal_velocity);
  }
  /// Whether E is needed at all.
  [[nodiscard]] bool is_energetic() const { return analytic::is_energetic(rule_.law); }
  [[nodiscard]] double damping() const { return rule_.damping; }
  /// A strongly damped ground gives its last energy back while u is 1/τ to rounding, which is that of p and of 1.
  [[nodiscard]] bool is_at_limit_speed() const {
    constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
    return stage_ == Stage::restitution && is_energetic() &&
           1 - rule_.damping * detail::value_of(at.normal_velocity) <=
               rounding * (1 + rule_.damping * detail::value_of(at.impulse));
  }

  Measure<Number> at;
  std::array<Number, 2> friction{};                               ///< P_t
  Number slip;                                                    ///< σ
  double least_slip;                                              ///< smallest σ so far
  Number compression = std::numeric_limits<double>::quiet_NaN();  ///< p_c

 private:
  void advance(const Line& line, const Number& length);

  RestitutionRule rule_;
  Number approach_;
  Stage stage_ = Stage::compression;
};

template <class Number>
template <class Value>
Value PathProgress<Number>::excess(const Measure<Value>& m) const {
  const auto known = [](const Number& number) -> Value {
    if constexpr (std::is_same_v<Value, Number>) return number;
    else return detail::value_of(number);
  };
  if (stage_ != Stage::restitution) return m.normal_velocity;
  if (rule_.law == RestitutionLaw::newton) return m.normal_velocity - rule_.restitution * known(approach_);
  if (rule_.law == RestitutionLaw::poisson) return m.impulse - (1 + rule_.restitution) * known(compression);
  return -m.store;
}

}  // namespace clatter::analytic::space
