// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/elastic_frame.hpp"

#include <cmath>

#include "analytic/detail/small_angle.hpp"

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

}  // namespace clatter::analytic
