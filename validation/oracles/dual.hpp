// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that carry their derivative, to know condition numbers at any precision.
#pragma once

#include <cmath>

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

}  // namespace clatter::oracle
