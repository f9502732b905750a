// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/measured_run.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "validation/output/bad_input.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation::inline cli {
namespace {

void refuse_two_splits(const MeasuredRequest& input) {
  const bool drawn = input.seed || input.share;
  if (input.fit_on && drawn) throw BadInput("--fit-on: excludes --seed and --share; give one of them, not both");
  if (input.fit_from && (drawn || input.fit_on))
    throw BadInput("--fit-from: excludes --seed, --share and --fit-on: all of the file is scored");
}

void refuse_empty(const MeasuredRun& run) {
  if (run.split.fitted.size() < 3 || run.split.scored.empty()) {
    throw BadInput(fmt::format("{}: {} drops to fit on and {} to score: at least 3 and 1 are needed",
                               run.file.file.path, run.split.fitted.size(), run.split.scored.size()));
  }
}

void split_file(const MeasuredRequest& input, MeasuredRun& run) {
  const std::size_t count = run.file.file.tracks.size();
  if (input.fit_on) {
    run.split = split_by_list(run.file.file, "--fit-on", *input.fit_on);
    run.split_words = fmt::format("fitted on the {} drops of a list, scored on the other {}", run.split.fitted.size(),
                                  run.split.scored.size());
  } else {
    const int seed = input.seed ? read_integer_option("--seed", *input.seed, 0, 2147483647) : 1;
    const double share =
        input.share ? read_number_option("--share", *input.share, {0, 1, true, "greater than 0, at most 1"}) : 0.5;
    run.split = split_by_seed(count, static_cast<std::uint64_t>(seed), share);
    run.split_words = fmt::format("fitted on {} drops drawn with seed {}, scored on the other {}",
                                  run.split.fitted.size(), seed, run.split.scored.size());
  }
  refuse_empty(run);
  run.fit = fit_measured(run.file, run.split.fitted);
}

TrackPart all_of(const MeasuredFile& file) {
  TrackPart all(file.tracks.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

/// Fits on another file of the same body: all of this one is scored.
void fit_elsewhere(const MeasuredRequest& input, const TrackDescription& description, MeasuredRun& run) {
  std::error_code error;
  if (*input.fit_from == run.file.file.path || std::filesystem::equivalent(*input.fit_from, run.file.file.path, error))
    throw BadInput(fmt::format("--fit-from {}: the file that is scored; nothing is fitted and scored on the same drops",
                               *input.fit_from));
  const MeasuredFile other = measure_tracks(read_tracks(*input.fit_from, description));
  run.fit = fit_measured(other, all_of(other));
  run.split.scored = all_of(run.file);
  run.split_words = fmt::format("fitted on the {} drops of {}, scored on {}", other.tracks.size(), *input.fit_from,
                                run.split.scored.size());
}

}  // namespace

MeasuredRun read_measured_run(const MeasuredRequest& input) {
  refuse_two_splits(input);
  const TrackDescription description = description_of(input.file, input.body);
  MeasuredRun run{
      .file = measure_tracks(read_tracks(input.file, description)), .split = {}, .fit = {}, .split_words = {}};
  if (input.fit_from) fit_elsewhere(input, description, run);
  else split_file(input, run);
  return run;
}

}  // namespace clatter::validation::inline cli
