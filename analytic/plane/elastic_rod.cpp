// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/elastic_rod.hpp"

#include <cmath>

#include "analytic/base/angle.hpp"

namespace clatter::analytic {

namespace {

constexpr double root3 = 1.732050807568877293527446341505872367;
constexpr double cosines[6] = {1, 0.5, -0.5, -1, -0.5, 0.5};
/// sin(nπ/3)·2/√3
constexpr double sines[6] = {0, 1, 1, 0, -1, -1};

int wrap(int sextant) { return ((sextant % 6) + 6) % 6; }

/// cos(nπ/3) − cos(nπ/3 + deviation): the exact part is left out, so that it can be added last.
double shortfall(int sextant, double deviation) {
  return cosines[sextant] * detail::versine(deviation) + root3 / 2 * (sines[sextant] * std::sin(deviation));
}

double cosine_of(int sextant, double deviation) { return cosines[sextant] - shortfall(sextant, deviation); }

}  // namespace

double tilt_tangent(double sine, double cosine) {
  const double c = std::fabs(cosine);
  return sine * sine / (1 + c) / (1 + 3 * c);
}

ReflectionAxis reflection_axis(bool left_end, double sine, double cosine) {
  const double c = std::fabs(cosine);
  const double tilt = std::atan(root3 * tilt_tangent(sine, c));
  return {.sense = left_end == (cosine >= 0) ? 1 : -1,
          .tilt = tilt,
          .cosine = 0.5 * std::cos(tilt) + root3 / 2 * std::sin(tilt)};
}

double ElasticFrame::normal() const { return speed * cosine_of(sextant, deviation); }

double ElasticFrame::angular(double length) const {
  return speed / length *
         (3 * sines[sextant] * (1 - detail::versine(deviation)) + 2 * root3 * (cosines[sextant] * std::sin(deviation)));
}

double ElasticFrame::contact_velocity(const ReflectionAxis& axis) const {
  const double across = cosine_of(wrap(sextant - axis.sense), deviation + axis.sense * axis.tilt);
  return speed * across / axis.cosine;
}

double ElasticFrame::reflect(const ReflectionAxis& axis) {
  // 2 cos(χ − ψ) cos ψ = cos χ + cos(χ − 2ψ)
  const int mirrored = wrap(sextant - 2 * axis.sense);
  const double exact = cosines[sextant] + cosines[mirrored];
  const double small = shortfall(sextant, deviation) + shortfall(mirrored, deviation + 2 * axis.sense * axis.tilt);
  sextant = wrap(2 * axis.sense + 3 - sextant);
  deviation = -2 * axis.sense * axis.tilt - deviation;
  return speed * (small - exact);
}

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
