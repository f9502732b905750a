// SPDX-License-Identifier: GPL-3.0-or-later
// An inclination with its sine and cosine, exact at 0° and 90° when it comes in degrees.
#pragma once

#include <cmath>

namespace clatter::analytic {

inline constexpr double pi = 3.141592653589793238462643383279502884;
inline constexpr double degrees_per_radian = 57.29577951308232087679815481410517033;

/// An angle with its sine and cosine.
///
/// The double nearest to 90° in radians is not 90°, so an upright rod given in degrees would not be
/// upright any more.  Angles given in degrees therefore take sine and cosine from the distance to the
/// nearer of 0° and 90°, which is exact in floating point.
struct Angle {
  /// The angle 0°.  Members that do not belong to one angle are no Angle, and so none is made of them.
  Angle() = default;

  double radians = 0;  ///< [rad]
  double degrees = 0;  ///< [°]
  double sine = 0;
  double cosine = 1;

  /// @param degrees any finite value; sine and cosine are exact at multiples of 90° within ±90°.
  ///        Accuracy: radians 1 ulp; sine and cosine 2 ulp within [-90°, 90°].
  /// @throws std::domain_error if not finite.
  [[nodiscard]] static Angle from_degrees(double degrees);

  /// @param radians any finite value.  Accuracy: sine and cosine 1 ulp, degrees 1 ulp.
  /// @throws std::domain_error if not finite.
  [[nodiscard]] static Angle from_radians(double radians);
};

/// Acute angle between a line at this inclination and the ground, in [0, π/2] [rad].
[[nodiscard]] double acute_angle(double inclination);

}  // namespace clatter::analytic

namespace clatter::analytic::detail {

// Trigonometric differences that keep their relative accuracy for small angles.

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
