// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that carry derivatives: forward-mode differentiation.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace clatter::analytic::detail {

/// A number and its derivatives with respect to `size` variables.  Comparisons are those of values:
/// a function with branches gets the derivative of the branch that its value takes.
template <std::size_t size>
struct Dual {
  double value = 0;
  std::array<double, size> slope{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: numbers are constants
  Dual(double number, const std::array<double, size>& derivatives) : value(number), slope(derivatives) {}

  /// f of this number, where `f_value` and `f_slope` are f and f′ there.
  [[nodiscard]] Dual mapped(double f_value, double f_slope) const {
    return combined(f_value, *this, f_slope, Dual(), 0);
  }
  /// f of two numbers, where `of_a` and `of_b` are the derivatives of f there.
  [[nodiscard]] static Dual combined(double f_value, const Dual& a, double of_a, const Dual& b, double of_b) {
    Dual result(f_value);
    for (std::size_t i = 0; i < size; ++i) result.slope[i] = of_a * a.slope[i] + of_b * b.slope[i];
    return result;
  }

  friend Dual operator-(const Dual& a) { return a.mapped(-a.value, -1); }
  friend Dual operator+(const Dual& a, const Dual& b) { return combined(a.value + b.value, a, 1, b, 1); }
  friend Dual operator-(const Dual& a, const Dual& b) { return combined(a.value - b.value, a, 1, b, -1); }
  friend Dual operator*(const Dual& a, const Dual& b) { return combined(a.value * b.value, a, b.value, b, a.value); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
    return combined(quotient, a, 1 / b.value, b, -quotient / b.value);
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
  /// Constant at 0.
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.mapped(root, root > 0 ? 0.5 / root : 0);
  }
  friend Dual fma(const Dual& a, const Dual& b, const Dual& c) {
    return combined(std::fma(a.value, b.value, c.value), a * b, 1, c, 1);
  }
};

inline double value_of(double number) { return number; }
template <std::size_t size>
double value_of(const Dual<size>& number) {
  return number.value;
}

}  // namespace clatter::analytic::detail
