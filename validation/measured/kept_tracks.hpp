// SPDX-License-Identifier: GPL-3.0-or-later
// The tracked drops that the program carries: parts of two published data sets.
#pragma once

#include <string>
#include <vector>

#include "validation/measured/score.hpp"

namespace clatter::validation::inline measured {

/// Fitted on one half of a set's drops, drawn with seed 1, and scored on the other.
/// @param name  "square-drops" or "cube-tosses"
[[nodiscard]] Scores kept_scores(const std::string& name);

/// Every drop of a set, each predicted with what the other half fits.
struct CrossedScores {
  std::vector<ResidualBin> bins;
  double flat_rebound = 0;  ///< middle error of the flat rebound, the larger of both halves
};
[[nodiscard]] CrossedScores crossed_scores(const std::string& name);

}  // namespace clatter::validation::inline measured
