// SPDX-License-Identifier: GPL-3.0-or-later
// Ten thousand rods at 0.5° to 29.5°: how many impacts each has, the hardest one, and what that gains per degree.
#include <array>
#include <clatter/analytic.hpp>
#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  using namespace clatter::analytic;
  constexpr std::size_t count = 10'000;
  std::vector<double> inclination(count);
  for (std::size_t i = 0; i < count; ++i)
    inclination[i] = Angle::from_degrees(0.5 + 29 * static_cast<double>(i) / (count - 1)).radians;
  const std::array<double, 1> normal{-1}, restitution{0.6};  // one number for all; what is left out is as in Drop
  const BatchDrops drops{.body = make_rod({.mass = 1, .length = 1, .radius = 0}),
                         .inclination = inclination,
                         .normal = normal,
                         .restitution = restitution};
  std::vector<BatchOutcome> outcomes(count);
  run_batch(drops, {.limit = 6}, 0, outcomes);

  std::array<int, 7> rods{};
  std::size_t worst = 0;
  for (std::size_t i = 0; i < count; ++i) {
    ++rods.at(static_cast<std::size_t>(outcomes[i].impacts));
    if (outcomes[i].largest > outcomes[worst].largest) worst = i;
  }
  for (std::size_t n = 1; n < rods.size(); ++n)
    std::printf("%d rods with %zu%s impacts\n", rods[n], n, n == 6 ? "+" : "");

  // One of them with its rows, errors and derivatives.
  const SequenceGradient gradient = sequence_gradient(drops.drop(worst), outcomes[worst].hardest);
  const ImpactRow& row = gradient.sequence.rows.back();
  constexpr auto angle = static_cast<std::size_t>(DropParameter::angle);
  if (!gradient.refused[angle].reason.empty()) return 1;
  std::printf("rod %zu, impact %zu: %.6f +- %.1g N s, %+.2g N s per degree\n", worst, gradient.sequence.rows.size(),
              row.impulse().z(), row.error.normal_impulse,
              gradient.rows.back().of[angle].normal_impulse * Angle::from_degrees(1).radians);
  return std::fabs(row.impulse().z() - outcomes[worst].largest) <= row.error.normal_impulse ? 0 : 1;
}
