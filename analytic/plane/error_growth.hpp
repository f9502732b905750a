// SPDX-License-Identifier: GPL-3.0-or-later
// How errors of the start and of rounding grow along an impact sequence.
//
// The state (t, α, u, s, Ω, ΣP) of a body whose vertex touches the ground goes through impacts and
// flights by their Jacobians, and with it independent errors: one unit in the last place of each
// number of the drop, and the rounding of each step.  What a Jacobian cannot tell ends the
// prediction: a second vertex that arrives, or passes the ground, within the error, and an error so
// large beside a graze that the root's parabola shows.
#pragma once

#include <array>
#include <cstddef>

#include "analytic/plane/body_motion.hpp"
#include "analytic/plane/impact_rows.hpp"
#include "analytic/plane/step_jacobians.hpp"

namespace clatter::analytic {

/// Independent errors of a state: column k of F holds what the k-th does to the state, so that the
/// covariance is F Fᵀ.
///
/// Errors of one state are strongly correlated, and what one step blows up the next may bring
/// together again.  A bound for each number alone would lose that; the factor does not, and keeps
/// the relative accuracy of each row, be the numbers as different in size as the time and the speed
/// of the smallest bounce.
class ErrorFactor {
 public:
  /// One more independent error.
  void add(const StateVector& column);
  /// One more independent error, of one number alone.
  void add(std::size_t number, double size);
  /// F ← J F.
  void advance(const StateMatrix& jacobian);
  /// Standard deviation of gradient · state; infinite once an error was not finite.
  [[nodiscard]] double deviation(const StateVector& gradient) const;
  /// The deviation of one number of the state.
  [[nodiscard]] double deviation_of(std::size_t number) const;

 private:
  static constexpr std::size_t capacity = 24;
  using Row = std::array<double, capacity>;

  void make_room(std::size_t columns);
  void append_alone();

  std::array<Row, state_size> rows_{};  ///< of F but for `alone_`; zero beyond `columns_`
  std::size_t columns_ = 0;
  StateVector alone_{};  ///< errors of single numbers since the last advance(), each a column
  bool known_ = true;
};

/// The impact of `row` that `motion` has just had, of which the row has vertices, velocity before and impact.
[[nodiscard]] StruckState struck_state(const BodyMotion& motion, const ImpactLaw& law, const ImpactRow& row);

class ErrorGrowth {
 public:
  /// @param motion before its first impact; drop whose it is; both in internal units (impact_rows.hpp)
  /// @param sums_only only what summed_sequence() gives
  ErrorGrowth(const BodyMotion& motion, const Drop& drop, bool sums_only);

  /// Errors and amplification of a row whose impact `motion` has just had; errors go through the
  /// impact.
  void strike(const BodyMotion& motion, const ImpactLaw& law, ImpactRow& row);
  /// Errors go through the flight that `motion` has just flown; `flown.arrival` as it was found.
  void fly(const BodyMotion& motion, const FlownState& flown);
  /// Whether a flight without a contact is one for certain.
  void end_without_contact(const BodyMotion& motion, const FlownState& flown);

  [[nodiscard]] bool predictable() const { return predictable_; }
  /// Bound on the error of the sum of the normal impulses so far [N·s].
  [[nodiscard]] double total_impulse() const;
  /// Adds to the errors of a tail those of the state after the last impact, from which its sums
  /// begin.
  void add_to(const BodyMotion& motion, Tail& tail) const;

 private:
  [[nodiscard]] double alone(const StateVector& gradient) const { return deviations * factor_.deviation(gradient); }
  [[nodiscard]] double alone(StateIndex number) const { return deviations * factor_.deviation_of(number); }
  /// @param of a gradient, or one number of the state
  [[nodiscard]] double bound(const auto& of, double rounding) const {
    return (alone(of) + 2 * rounding) * (1 + curvature_);
  }
  void fill_summed(const StruckState& struck, const ImpactDerivatives& d, ImpactRow& row) const;
  void fill_after(const BodyMotion& motion, const StruckState& struck, ImpactRow& row);
  void fill(const BodyMotion& motion, const StruckState& struck, const ImpactDerivatives& d, ImpactRow& row) const;
  [[nodiscard]] double amplification(const ImpactDerivatives& d, const ImpactRow& row) const;
  void add_rounding(const StruckState& struck, const Impact& impact);
  void advance(const StateMatrix& jacobian);
  /// How the vertex that arrives comes down.
  struct Fall {
    double velocity;         ///< h′ [m/s]
    double height_rounding;  ///< [m]
  };
  void check_arrival(const FlownState& flown, const Moment& touch, const Fall& fall);
  void check_passes(const FlownState& flown, const Passes& passes, double until);

  /// Bounds are this many standard deviations of the errors assumed.
  static constexpr double deviations = 3;

  bool sums_only_;
  ErrorFactor factor_;
  StateVector of_angle_{}, of_speed_{};  ///< changes of the state for relative changes of the
                                         ///< drop's angle and speed by 1
  double curvature_ = 0;                 ///< largest share of the second order so far, relative to the first
  double total_impulse_ = 0;
  double energy_ = 0;  ///< bound on the error of the energy, where the ground slopes [J]
  bool predictable_ = true;
};

}  // namespace clatter::analytic
