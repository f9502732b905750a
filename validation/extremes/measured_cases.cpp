// SPDX-License-Identifier: GPL-3.0-or-later
// Where a rigid body that strikes with one corner stops describing tracked drops.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "validation/extremes/cell.hpp"
#include "validation/extremes/extreme_cases.hpp"
#include "validation/measured/score.hpp"

namespace clatter::validation::inline extremes {
namespace {

/// The drops whose arm at impact 1 is inclined from `low` on.
CellMeasure residual(const CrossedScores& scores, double low) {
  const auto bin = std::find_if(scores.bins.begin(), scores.bins.end(),
                                [&](const ResidualBin& one) { return one.quantity == "angle" && one.low == low; });
  if (bin == scores.bins.end()) throw analytic::OutsideModelError("none of the tracked drops strikes at this angle");
  if (2 * bin->points < bin->impacts) {
    throw analytic::OutsideModelError("most of the tracked drops strike with more than one corner within a frame");
  }
  return {.error = bin->error,
          .bound = scores.flat_rebound,
          .oracle = "tracked drops, each predicted with what the other half fits; the bound is a flat rebound's error",
          .outcome = fmt::format("{} of {} are point impacts", bin->points, bin->impacts)};
}

}  // namespace

std::vector<ExtremeCase> measured_cases(const MapAxis& axis) {
  const bool squares = axis.name == "squares";
  const auto scores = std::make_shared<const CrossedScores>(crossed_scores(squares ? "square-drops" : "cube-tosses"));
  std::vector<ExtremeCase> cases;
  for (const AxisValue& at : axis.values) {
    cases.push_back({axis.name, at.value, at.label, squares ? ModelLevel::discrete : ModelLevel::discrete_in_space,
                     [scores, low = at.value](const CellClock&) { return residual(*scores, low); }});
  }
  return cases;
}

}  // namespace clatter::validation::inline extremes
