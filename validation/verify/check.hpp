// SPDX-License-Identifier: GPL-3.0-or-later
// Checks: what is claimed, who judges it, and how far the two may be apart.
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/compare/case_runs.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation::inline verify {

/// What a measurement says of a claim.
enum class Answer {
  holds,
  refuted,    ///< the number is another one
  ambiguous,  ///< the text leaves open what it means; the number says what each reading gives
};
[[nodiscard]] const char* answer_name(Answer answer);
/// Of a claim in words: whether the inequality that it states does hold.
[[nodiscard]] inline Answer holds_if(bool claim) { return claim ? Answer::holds : Answer::refuted; }
/// Of a claim that prints a number: whether `value` rounds to `printed`, given with `unit` of its last digit.
[[nodiscard]] inline Answer rounds_to(double value, double printed, double unit) {
  return holds_if(std::fabs(value - printed) <= unit / 2);
}
/// A number of what was found.
[[nodiscard]] inline std::string number(double value, int digits = 5) { return significant(value, digits); }

/// One row of validation/verify/checks.toml.
struct Check {
  std::string id;  ///< C1 … C20 claims, E1 … E11 errata, F7 … F24 figures, X… exact results, M… scenes, R… random, B…
                   ///< error bars, S… the discrete model in space
  std::string what;    ///< in a few words
  std::string claim;   ///< in full
  std::string number;  ///< which number is measured
  std::string unit;
  std::string oracle;             ///< closed form, 30-digit table, conservation law, other model, convergence
  std::string error;              ///< how the error is formed
  double seen = 0;                ///< error when the tolerance was set; at least one unit in the last place
  double tolerance = 0;           ///< the error may be this; at most 5 × seen
  std::string reason;             ///< of the tolerance
  Answer answer = Answer::holds;  ///< expected
  bool quick = true;              ///< belongs to --quick
  std::optional<int> figure;
  std::string command;  ///< that shows the number
};

/// The table.  @throws std::runtime_error if it is not sound (an id twice, a tolerance above 5 × seen …).
[[nodiscard]] const std::vector<Check>& all_checks();

/// What a measurement found.
struct Measured {
  double number = 0;
  double error = 0;  ///< against the oracle
  Answer answer = Answer::holds;
  std::string found;  ///< in words, with further numbers
};

using Measure = Measured (*)(CaseRuns&);
using Measures = std::map<std::string, Measure>;

/// The measurement of each check, by its id.
[[nodiscard]] const Measures& all_measures();

/// Each group adds its own.
void add_exact_measures(Measures& measures);
void add_angle_claim_measures(Measures& measures);
void add_claim_measures(Measures& measures);
void add_erratum_measures(Measures& measures);
void add_figure_measures(Measures& measures);
void add_model_measures(Measures& measures);
void add_bar_measures(Measures& measures);
void add_space_measures(Measures& measures);
void add_measured_measures(Measures& measures);

}  // namespace clatter::validation::inline verify
