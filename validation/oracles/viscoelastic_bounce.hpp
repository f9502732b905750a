// SPDX-License-Identifier: GPL-3.0-or-later
// A bounce on a damped spring, integrated in time.
#pragma once

namespace clatter::analytic::test {

/// e of a mass that meets the ground force (1 + τ δ̇) δ with the approach speed u: δ̈ = −(1 + τ δ̇) δ from δ = 0, δ̇ = u
/// until δ = 0 again, by Runge and Kutta's method; the time of the end by Newton's.  Error: below 1e-10 for τ u <= 2.
inline double integrated_restitution(double damping_per_stiffness, double approach_speed) {
  struct Motion {
    double depth, speed;
  };
  const auto rate = [&](const Motion& m) { return Motion{m.speed, -(1 + damping_per_stiffness * m.speed) * m.depth}; };
  const auto stepped = [&](const Motion& m, double h) {
    const auto at = [&](const Motion& k, double part) {
      return rate({m.depth + part * k.depth, m.speed + part * k.speed});
    };
    const Motion a = rate(m), b = at(a, h / 2), c = at(b, h / 2), d = at(c, h);
    return Motion{m.depth + h / 6 * (a.depth + 2 * b.depth + 2 * c.depth + d.depth),
                  m.speed + h / 6 * (a.speed + 2 * b.speed + 2 * c.speed + d.speed)};
  };
  constexpr double step = 1e-3;
  Motion now = stepped({0, approach_speed}, step);
  while (now.depth > 0) now = stepped(now, step);
  for (int i = 0; i < 4; ++i) now = stepped(now, -now.depth / now.speed);
  return -now.speed / approach_speed;
}

}  // namespace clatter::analytic::test
