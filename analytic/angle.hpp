// SPDX-License-Identifier: GPL-3.0-or-later
// An inclination with its sine and cosine, exact at 0° and 90° when it comes in degrees.
#pragma once

namespace clatter::analytic {

inline constexpr double pi = 3.141592653589793238462643383279502884;
inline constexpr double degrees_per_radian = 57.29577951308232087679815481410517033;

/// An angle with its sine and cosine.
///
/// The double nearest to 90° in radians is not 90°, so an upright rod given in degrees would not be
/// upright any more.  Angles given in degrees therefore take sine and cosine from the distance to the
/// nearer of 0° and 90°, which is exact in floating point.
struct Angle {
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
