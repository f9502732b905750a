// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/elastic_offsets.hpp"

#include <cmath>

#include "analytic/detail/small_angle.hpp"
#include "analytic/elastic_frame.hpp"

namespace clatter::analytic {
namespace {

using detail::sine_deficit;

/// Solves sin(a+x) − sin a − K x = rise by Newton's method.  For small angles the first guess comes
/// from `rise`, since the one given holds no digits of x.
double solve_offset(double a, double k, double rise, double guess) {
  double x = a < 0.03 ? rise / (std::cos(a) - k) : guess;
  for (int i = 0; i < 3; ++i) {
    const double value = 2 * std::cos(a + x / 2) * std::sin(x / 2) - k * x - rise;
    const double slope = std::cos(a + x) - k;
    const double step = value / slope;
    if (!(std::fabs(step) <= 1e-3 * std::fabs(x))) break;  // at a fold, or nothing to gain
    x -= step;
  }
  if (!(std::fabs(x) < 0.05)) return x;
  // The same equation with its largest term alone on the left, which rounds least.
  return (rise + std::cos(a) * sine_deficit(x) + std::sin(a) * detail::versine(x)) / (std::cos(a) - k);
}

}  // namespace

double first_offset(const Angle& theta, double beta) {
  const double t = theta.radians;
  const double c = theta.cosine;
  const double k1 = theta.sine * theta.sine * (1 + 3 * c) / (6 * c * (1 + c));
  const double rise = 1.5 * k1 * t - sine_deficit(t) + sine_deficit(t / 2);
  return solve_offset(t / 2, k1 - 1.0 / 3, rise, beta - t / 2);
}

double second_offset(const Angle& theta, double eta, double gamma) {
  const double t = theta.radians;
  const double beta = t / 2 + eta;
  // K₂ = tan(π/6 + 2δ₁ + 2δ₂)/√3, by the addition theorems of the tangent with tan δ = √3 u.
  const double u1 = tilt_tangent(theta.sine, theta.cosine);
  const double u2 = tilt_tangent(std::sin(beta), std::cos(beta));
  const double single = 3 * (u1 + u2) / (1 - 3 * u1 * u2);      // √3 tan(δ₁ + δ₂)
  const double twice = 2 * single / (1 - single * single / 3);  // √3 tan(2δ₁ + 2δ₂)
  const double k2 = 4 * twice / (9 - 3 * twice);
  const double rise = 1.5 * k2 * t + (k2 + 4.0 / 3) * eta + sine_deficit(t) - sine_deficit(beta);
  return solve_offset(t, k2 + 1.0 / 3, rise, gamma - t);
}

}  // namespace clatter::analytic
