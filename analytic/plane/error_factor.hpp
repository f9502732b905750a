// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of a state of several numbers, to first order, as a factor of their covariance.
#pragma once

#include <array>
#include <cstddef>

namespace clatter::analytic {

/// Time, inclination, normal velocity and slip of the contact point, Ω, and the sum of the normal
/// impulses so far.
inline constexpr std::size_t state_size = 6;
using StateVector = std::array<double, state_size>;
/// Rows: derivatives of one number of the new state with respect to the numbers of the old one.
using StateMatrix = std::array<StateVector, state_size>;

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

/// J v.
[[nodiscard]] StateVector product(const StateMatrix& jacobian, const StateVector& vector);

}  // namespace clatter::analytic
