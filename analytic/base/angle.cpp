// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/base/angle.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace clatter::analytic {

namespace {

// π/180 as the sum of two doubles.
constexpr double radians_high = 0.017453292519943295;
constexpr double radians_low = 2.9486522708701687e-19;

double radians_of(double degrees) { return std::fma(degrees, radians_high, degrees * radians_low); }

void require_finite(double angle) {
  if (!std::isfinite(angle)) throw std::domain_error("angle = " + std::to_string(angle) + ": must be finite");
}

Angle angle_of(double radians, double degrees, double sine, double cosine) {
  Angle angle;
  angle.radians = radians;
  angle.degrees = degrees;
  angle.sine = sine;
  angle.cosine = cosine;
  return angle;
}

}  // namespace

Angle Angle::from_degrees(double degrees) {
  require_finite(degrees);
  const double size = std::fabs(degrees);
  const double radians = radians_of(degrees);
  if (size <= 45 || size > 90) return angle_of(radians, degrees, std::sin(radians), std::cos(radians));
  const double complement = radians_of(90 - size);  // 90 − size is exact here
  return angle_of(radians, degrees, std::copysign(std::cos(complement), degrees), std::sin(complement));
}

Angle Angle::from_radians(double radians) {
  require_finite(radians);
  return angle_of(radians, radians * degrees_per_radian, std::sin(radians), std::cos(radians));
}

double acute_angle(double inclination) { return std::fabs(std::remainder(inclination, pi)); }

}  // namespace clatter::analytic
