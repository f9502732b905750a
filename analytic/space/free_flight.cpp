// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/free_flight.hpp"

#include <cmath>

#include "analytic/detail/limits.hpp"

namespace clatter::analytic::space {

using detail::never_happens;

namespace {}  // namespace

State FreeFlight::at(double time) const {
  State state;
  state.position = start_.position + time * start_.velocity;
  state.position.z() = centre_height(time);
  state.velocity = start_.velocity;
  state.velocity.z() = centre_velocity(time);
  state.attitude = rotation_.attitude(time);
  state.angular_velocity = state.attitude * rotation_.angular_velocity(time);
  return state;
}

double FreeFlight::falls_through(double height) const {
  const double above = start_.position.z() - height, velocity = start_.velocity.z();
  if (gravity_ > 0) {
    const double square = velocity * velocity + 2 * gravity_ * above;
    if (!(square > 0)) return 0;
    const double root = std::sqrt(square);
    // Of (V + √…)/g and its conjugate the one that does not cancel.
    return std::fmax(velocity > 0 ? (velocity + root) / gravity_ : 2 * above / (root - velocity), 0.0);
  }
  return velocity < 0 ? std::fmax(above / -velocity, 0.0) : never_happens;
}

double FreeFlight::rises_through(double height) const {
  const double below = height - start_.position.z(), velocity = start_.velocity.z();
  if (!(below > 0)) return 0;
  if (!(velocity > 0)) return never_happens;
  const double square = velocity * velocity - 2 * gravity_ * below;
  return square > 0 ? 2 * below / (velocity + std::sqrt(square)) : never_happens;
}

}  // namespace clatter::analytic::space
