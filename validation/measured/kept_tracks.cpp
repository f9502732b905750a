// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/kept_tracks.hpp"

#include <cmath>

namespace clatter::validation::inline measured {
namespace {

constexpr std::uint64_t split_seed = 1;

MeasuredFile kept_file(const std::string& name) { return measure_tracks(carried_tracks(name, read_description(name))); }

Scores scores_of(const MeasuredFile& file, const TrackPart& fitted, const TrackPart& scored) {
  return score_measured(file, fit_measured(file, fitted), scored, false);
}

}  // namespace

Scores kept_scores(const std::string& name) {
  const MeasuredFile file = kept_file(name);
  const TrackSplit split = split_by_seed(file.tracks.size(), split_seed, 0.5);
  return scores_of(file, split.fitted, split.scored);
}

CrossedScores crossed_scores(const std::string& name) {
  const MeasuredFile file = kept_file(name);
  const TrackSplit split = split_by_seed(file.tracks.size(), split_seed, 0.5);
  Scores one = scores_of(file, split.fitted, split.scored);
  const Scores other = scores_of(file, split.scored, split.fitted);
  const auto flat = [](const Scores& scores) { return scores.middle_of("flat rebound"); };
  one.drops.insert(one.drops.end(), other.drops.begin(), other.drops.end());
  return {residual_bins(one.drops), std::fmax(flat(one), flat(other))};
}

}  // namespace clatter::validation::inline measured
