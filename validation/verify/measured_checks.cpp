// SPDX-License-Identifier: GPL-3.0-or-later
// Predictions held against drops that cameras tracked.
#include <fmt/format.h>

#include "validation/measured/score.hpp"
#include "validation/output/number.hpp"
#include "validation/verify/check.hpp"

namespace clatter::validation::inline verify {
namespace {

Measured velocities(const std::string& name) {
  const Scores scores = kept_scores(name);
  const double error = scores.middle_of("as fitted");
  return {100 * error, error, Answer::holds,
          fmt::format("{} point impacts; no change {} %, the best impulse there {} %", scores.rows[0].errors.size(),
                      significant(100 * scores.middle_of("no change"), 3),
                      significant(100 * scores.middle_of("floor: any impulse there"), 2))};
}

Measured squares(CaseRuns&) { return velocities("square-drops"); }
Measured cubes(CaseRuns&) { return velocities("cube-tosses"); }

/// Impacts that no impulse at one corner explains are two or more impacts of the sequence.
Measured clattering(CaseRuns&) {
  const Scores scores = kept_scores("square-drops");
  const double one = scores.middle_of("no point impact: one impact"),
               sequence = scores.middle_of("no point impact: the sequence");
  return {100 * sequence, sequence, holds_if(sequence < one),
          fmt::format("with one impact alone {} %", significant(100 * one, 3))};
}

}  // namespace

void add_measured_measures(Measures& measures) {
  measures["X20"] = squares;
  measures["X21"] = cubes;
  measures["X22"] = clattering;
}

}  // namespace clatter::validation::inline verify
