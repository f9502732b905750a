// SPDX-License-Identifier: GPL-3.0-or-later
// A box on its corner: the impacts of the continuous model in space.
#include <clatter/numeric.hpp>
#include <cstdio>

int main() {
  using namespace clatter::numeric;
  const Body body(box_mesh({.size = {0.14, 0.07, 0.008}, .mass = 0.18, .nx = 1, .ny = 1, .nz = 1}));
  const World world{.ground = {.stiffness = 1e9}};
  const MotionState start = touching_state(body, {.inclination = 0.5, .out_of_plane_tilt = 0.3});
  const Simulation run = simulate(body, world, start, {.impacts = 2});
  for (const ImpactRecord& row : run.impacts) std::printf("%.6f s  %.6f N s\n", row.value.start, row.value.impulse.z());
  return run.impacts.size() == 2 ? 0 : 1;
}
