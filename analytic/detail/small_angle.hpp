// SPDX-License-Identifier: GPL-3.0-or-later
// Trigonometric differences that keep their relative accuracy for small angles.
#pragma once

#include <cmath>

namespace clatter::analytic::detail {

/// 1 − cos x = 2 sin²(x/2).  Accuracy: 2 ulp.
inline double versine(double x) {
  const double half = std::sin(x / 2);
  return 2 * half * half;
}

/// x − sin x; below |x| = 1/2 by its series.  Accuracy: 2 ulp for |x| < 1/2, else 8 ulp.
inline double sine_deficit(double x) {
  if (!(std::fabs(x) < 0.5)) return x - std::sin(x);
  const double y = x * x;
  double sum = 1.0 / 1307674368000.0;  // 1/15!
  sum = 1.0 / 6227020800.0 - y * sum;  // 1/13!
  sum = 1.0 / 39916800.0 - y * sum;    // 1/11!
  sum = 1.0 / 362880.0 - y * sum;      // 1/9!
  sum = 1.0 / 5040.0 - y * sum;        // 1/7!
  sum = 1.0 / 120.0 - y * sum;         // 1/5!
  sum = 1.0 / 6.0 - y * sum;           // 1/3!
  return x * (y * sum);
}

/// The functions of an angle turned that heights, velocities and their derivatives share.
struct Turn {
  double angle;         ///< x
  double sine;          ///< sin x
  double versine;       ///< 1 − cos x
  double sine_deficit;  ///< x − sin x

  explicit Turn(double x) : angle(x) {
    const double half_sine = std::sin(x / 2), half_cosine = std::cos(x / 2);
    sine = 2 * half_sine * half_cosine;
    versine = 2 * half_sine * half_sine;
    sine_deficit = std::fabs(x) < 0.5 ? detail::sine_deficit(x) : x - sine;
  }
};

}  // namespace clatter::analytic::detail
