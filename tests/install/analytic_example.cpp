// SPDX-License-Identifier: GPL-3.0-or-later
// A rod at 10°: the impact sequence of the discrete model.
#include <clatter/analytic.hpp>
#include <cstdio>

int main() {
  using namespace clatter::analytic;
  Drop drop;
  drop.body = make_rod({.mass = 1, .length = 1, .radius = 0});
  drop.inclination = Angle::from_degrees(10);
  drop.velocity.normal = -1;
  const Sequence sequence = impact_sequence(drop, {.impacts = 6});
  for (const ImpactRow& row : sequence.rows) std::printf("%.6f s  %.6f N s\n", row.start, row.impulse().z());
  return sequence.outcome == Outcome::no_further_impact ? 0 : 1;
}
