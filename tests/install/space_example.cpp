// SPDX-License-Identifier: GPL-3.0-or-later
// A phone on its corner: the impact sequence of the discrete model in space, with friction.
#include <clatter/analytic.hpp>
#include <cmath>
#include <cstdio>

int main() {
  using namespace clatter::analytic;
  space::Drop drop;
  drop.body = space::make_box({.mass = 0.18, .length = 0.14, .width = 0.07, .thickness = 0.008});
  drop.attitude = Eigen::AngleAxisd(0.5, space::Vector3(1, -1, 0).normalized());
  drop.velocity.z() = -1;
  drop.law = {.restitution = 0.8, .friction = FrictionKind::coulomb, .friction_value = 0.3};
  const space::Sequence sequence = impact_sequence(drop, {.impacts = 2}, {0.001, 0.002});  // and the states then
  double impulse = 0;
  for (const space::ImpactRow& row : sequence.rows) {
    std::printf("%.6f s  %.6f +- %.1g N s\n", row.start, row.impulse().z(), row.error.impulse);
    impulse += row.impulse().z();
  }
  for (const space::StateAt& at : sequence.states)
    std::printf("%g s: %.6f +- %.1g m high\n", at.time, at.state.position.z(), at.position_error);
  // Without gravity the impulses are what changed the momentum.
  const double change = 0.18 * (sequence.rows.back().velocity_after().z() + 1);
  return sequence.rows.size() == 2 && std::fabs(impulse - change) < 1e-12 ? 0 : 1;
}
