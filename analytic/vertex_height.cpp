// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/vertex_height.hpp"

#include <cmath>

namespace clatter::analytic {

VertexHeight::Value VertexHeight::at(double t, const detail::Turn& turn) const {
  const double linear = velocity * t;
  const double fall = gravity / 2 * t * t;
  const double versine_term = versine * turn.versine;
  const double sine_term = sine * turn.sine_deficit;
  return {.height = height + linear - fall + versine_term + sine_term,
          .velocity = velocity - gravity * t + rate * (versine * turn.sine + sine * turn.versine),
          .scale =
              std::fabs(height) + std::fabs(linear) + std::fabs(fall) + std::fabs(versine_term) + std::fabs(sine_term)};
}

double VertexHeight::acceleration(double t) const {
  const double turned = rate * t;
  return rate * rate * (versine * std::cos(turned) + sine * std::sin(turned)) - gravity;
}

double VertexHeight::velocity_scale(double t) const {
  const double turned = rate * t;
  const double reach = std::fabs(versine) + std::fabs(sine);
  const double of_turning =
      rate * (std::fabs(versine) * std::fmin(turned, 1) + std::fabs(sine) * std::fmin(turned * turned, 1));
  return std::fabs(velocity) + gravity * t + of_turning + (turned > 1 ? turned * rate * reach : 0);
}

}  // namespace clatter::analytic
