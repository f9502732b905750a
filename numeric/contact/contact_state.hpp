// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a contact that is stepped, U of Eq. 3 of Shan et al. (2005): a vector with named blocks.
#pragma once

#include <Eigen/Core>

namespace clatter::numeric {

/// State of a contact.  Everything is relative to the touch-down, so that depths of a billionth of the body's size
/// keep their digits.
///     r       displacement of the centre of mass, world [m]
///     β       Euler parameters of the rotation since touch-down
///     V       velocity of the centre of mass, world [m/s]
///     ω′      angular velocity, body frame [rad/s]
///     W_d, W_r, W_f   energy dissipated by dampers, released by the clamp, dissipated by friction [J]
using ContactState = Eigen::Matrix<double, 16, 1>;

template <class State>
auto displacement(State& y) {
  return y.template head<3>();
}
template <class State>
auto euler_parameters(State& y) {
  return y.template segment<4>(3);
}
template <class State>
auto velocity(State& y) {
  return y.template segment<3>(7);
}
/// ω′.
template <class State>
auto angular_velocity(State& y) {
  return y.template segment<3>(10);
}
/// W_d, W_r, W_f.
template <class State>
auto works(State& y) {
  return y.template tail<3>();
}
[[nodiscard]] inline double damping_work(const ContactState& y) { return works(y)[0]; }
[[nodiscard]] inline double released_work(const ContactState& y) { return works(y)[1]; }
[[nodiscard]] inline double friction_work(const ContactState& y) { return works(y)[2]; }

}  // namespace clatter::numeric
