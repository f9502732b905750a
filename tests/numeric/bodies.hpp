// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that several tests drop.
#pragma once

#include <numbers>

#include "numeric/body.hpp"
#include "numeric/mesh/generators.hpp"
#include "numeric/simulate.hpp"

namespace clatter::numeric::test {

inline constexpr double degree = std::numbers::pi / 180;

inline Body box_body(const Vector3& size, double mass, int nx = 1, int ny = 1, int nz = 1, bool merge = true) {
  return Body(box_mesh({.size = size, .mass = mass, .nx = nx, .ny = ny, .nz = nz}), merge);
}

/// The paper's phone.
inline constexpr double phone_mass = 0.08814;
inline Vector3 phone_size() { return {0.10566, 0.04394, 0.01905}; }
inline Body phone(int nx = 1, int ny = 1, int nz = 1, bool merge = true) {
  return box_body(phone_size(), phone_mass, nx, ny, nz, merge);
}

/// The paper's rod.
inline Body rod() { return Body(rod_mesh({})); }

/// One impact without estimates, so that the work is one run's.
inline constexpr Request plain{.impacts = 1, .error_estimates = false, .amplification = false};
/// The same with more impacts.
inline Request plain_impacts(int impacts) {
  return {.impacts = impacts, .error_estimates = false, .amplification = false};
}

inline World weightless(const Ground& ground, bool planar = false) {
  return {.ground = ground, .gravity = 0, .planar = planar};
}

inline Simulation dropped(const Body& body, const World& world, double angle, double speed,
                          const Accuracy& accuracy = {}, const Observer& observer = {}) {
  return simulate(body, world, touching_state(body, {.inclination = angle, .velocity = {0, 0, -speed}}), plain,
                  accuracy, observer);
}

}  // namespace clatter::numeric::test
