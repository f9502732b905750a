// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/ground.hpp"

#include "numeric/base/errors.hpp"

namespace clatter::numeric {

void Ground::validate() const {
  using detail::require;
  require(modulus >= 0, "ground.modulus", modulus, "finite and at least 0");
  if (modulus > 0) {
    require(dissipation >= 0, "ground.dissipation", dissipation, "finite and at least 0");
  } else {
    require(stiffness > 0, "ground.stiffness", stiffness, "finite and greater than 0");
    require(damping >= 0, "ground.damping", damping, "finite and at least 0");
  }
  require(sliding_friction >= 0, "ground.sliding_friction", sliding_friction, "finite and at least 0");
  require(static_friction >= sliding_friction, "ground.static_friction", static_friction,
          "finite and at least the sliding friction");
  require(regularisation_speed > 0, "ground.regularisation_speed", regularisation_speed, "finite and greater than 0");
}

}  // namespace clatter::numeric
