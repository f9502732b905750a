// SPDX-License-Identifier: GPL-3.0-or-later
// A number with its error, sums of such numbers, and what a reader is shown of them.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "validation/output/number.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

/// The error of a number of which nothing is known.
inline constexpr double unknown_error = std::numeric_limits<double>::infinity();

/// A number with a bound on its error or an estimate of that.  An error that is not finite: nothing is known of the
/// number.
struct Estimated {
  double value = 0;
  double error = 0;

  [[nodiscard]] bool is_known() const { return std::isfinite(value) && std::isfinite(error); }

  /// Errors may be correlated: their sizes add up, |δ(a + b)| <= |δa| + |δb|, and half an ulp of the sum.  With one
  /// unknown summand the sum is unknown.
  Estimated& operator+=(const Estimated& other);
};
[[nodiscard]] inline Estimated operator+(Estimated a, const Estimated& b) { return a += b; }
[[nodiscard]] inline Estimated operator-(const Estimated& a, const Estimated& b) {
  return a + Estimated{-b.value, b.error};
}
/// Scaled by an exact factor.
[[nodiscard]] inline Estimated operator*(const Estimated& a, double factor) {
  return {a.value * factor, a.error * std::fabs(factor)};
}

/// The larger of two numbers: its error is at most the larger one of theirs.
[[nodiscard]] Estimated larger(const Estimated& a, const Estimated& b);

/// Digits asked for, and the size against which a number counts as zero.
struct Shown {
  int digits = 6;
  double size = 0;  ///< of such numbers in this run; 0: none, no number but 0 itself is shown as 0
};

/// The number with at most `shown.digits` digits and none that its error leaves open; "0" where value and error
/// together stay below 10^-d of `shown.size`, d the digits asked for, at most six; "?" where nothing is known.
[[nodiscard]] Cell known_cell(const Estimated& number, const Shown& shown);
[[nodiscard]] std::string known_text(const Estimated& number, const Shown& shown);

/// The same, but where the error leaves fewer than three digits the number beside it, 4.705±0.055.
[[nodiscard]] Cell measured_cell(const Estimated& number, int digits);

/// The error as outputs show it, with two significant digits; nothing where it is not known.
[[nodiscard]] inline Value error_or_nothing(const Estimated& number) {
  return number.is_known() ? Value(rounded_up(number.error)) : Value();
}

}  // namespace clatter::validation
