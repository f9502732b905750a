// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/ground.hpp"

#include <algorithm>

#include "numeric/base/errors.hpp"

namespace clatter::numeric {
namespace {

constexpr double sum_rounding = 1e-12;  ///< of the sum of the kinks' changes, which may be that of a level piece

void require_rising(const std::vector<Kink>& kinks) {
  double depth = 0, stiffness = 1, size = 1;
  for (const Kink& kink : kinks) {
    detail::require(kink.depth > depth, "ground.kinks: depth", kink.depth, "finite and greater than that before");
    depth = kink.depth;
    stiffness += kink.change;
    size = std::max(size, stiffness);
    detail::require(stiffness >= -sum_rounding * size, "ground.kinks: change", kink.change,
                    "finite and leave a stiffness of at least 0");
  }
}

}  // namespace

double Ground::pressed_depth(double depth) const {
  double sum = std::max(depth, 0.0);
  for (const Kink& kink : kinks) sum += kink.change * std::max(depth - kink.depth, 0.0);
  return std::max(sum, 0.0);
}

void Ground::validate() const {
  using detail::require;
  require(modulus >= 0, "ground.modulus", modulus, "finite and at least 0");
  require(dissipation >= 0, "ground.dissipation", dissipation, "finite and at least 0");
  require(damping >= 0, "ground.damping", damping, "finite and at least 0");
  if (has_dissipation()) require(damping == 0, "ground.damping", damping, "0: this ground has dissipation");
  else require(dissipation == 0, "ground.dissipation", dissipation, "0: this ground has damping");
  if (!is_half_space()) require(stiffness > 0, "ground.stiffness", stiffness, "finite and greater than 0");
  require_rising(kinks);
  require(sliding_friction >= 0, "ground.sliding_friction", sliding_friction, "finite and at least 0");
  require(static_friction >= sliding_friction, "ground.static_friction", static_friction,
          "finite and at least the sliding friction");
  require(regularisation_speed > 0, "ground.regularisation_speed", regularisation_speed, "finite and greater than 0");
}

}  // namespace clatter::numeric
