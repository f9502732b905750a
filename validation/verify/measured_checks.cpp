// Predictions held against drops that cameras tracked.
#include <fmt/format.h>

#include <algorithm>

#include "validation/embedded/embedded.hpp"
#include "validation/measured/score.hpp"
#include "validation/output/number.hpp"
#include "validation/verify/check.hpp"

namespace clatter::validation {
namespace {

constexpr std::uint64_t split_seed = 1;

/// The kept rows of a data set, fitted on one half of its drops and scored on the other.
Scores scores_of(const std::string& name) {
  const std::string csv = "validation/measured/" + name + ".csv";
  const MeasuredFile file = measure_tracks(parse_tracks(csv, std::string(embedded_text(csv)), read_description(name)));
  const TrackSplit split = split_by_seed(file.tracks.size(), split_seed, 0.5);
  return score_measured(file, fit_measured(file, split.fitted), split.scored, false);
}

double middle_of(const Scores& scores, const std::string& name) {
  const auto row =
      std::find_if(scores.rows.begin(), scores.rows.end(), [&](const auto& one) { return one.name == name; });
  return median(row->errors);
}

Measured velocities(const std::string& name) {
  const Scores scores = scores_of(name);
  const double error = middle_of(scores, "as fitted");
  return {100 * error, error, Answer::holds,
          fmt::format("{} point impacts; no change {} %, the best impulse there {} %", scores.rows[0].errors.size(),
                      significant(100 * middle_of(scores, "no change"), 3),
                      significant(100 * middle_of(scores, "floor: any impulse there"), 2))};
}

Measured squares(CaseRuns&) { return velocities("square-drops"); }
Measured cubes(CaseRuns&) { return velocities("cube-tosses"); }

/// Impacts that no impulse at one corner explains are two or more impacts of the sequence.
Measured clattering(CaseRuns&) {
  const Scores scores = scores_of("square-drops");
  const double one = middle_of(scores, "no point impact: one impact"),
               sequence = middle_of(scores, "no point impact: the sequence");
  return {100 * sequence, sequence, sequence < one ? Answer::holds : Answer::refuted,
          fmt::format("with one impact alone {} %", significant(100 * one, 3))};
}

}  // namespace

void add_measured_measures(Measures& measures) {
  measures["X20"] = squares;
  measures["X21"] = cubes;
  measures["X22"] = clattering;
}

}  // namespace clatter::validation
