// SPDX-License-Identifier: GPL-3.0-or-later
// Checks: what is claimed, who judges it, how far the two may be apart; which of them run, and what comes of it.
#pragma once

#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analytic/plane/contact_angles.hpp"
#include "validation/compare/case_runs.hpp"
#include "validation/oracles/reference_table.hpp"
#include "validation/output/number.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

/// What a measurement says of a claim.
enum class Finding {
  holds,
  refuted,    ///< the number is another one
  ambiguous,  ///< the text leaves open what it means; the number says what each reading gives
  misprint,   ///< of an erratum: the printed form gives another number than the right one
};
[[nodiscard]] const char* answer_name(Finding answer);
/// The answer to a claim in words, given whether the inequality that it states holds.
[[nodiscard]] inline Finding holds_if(bool claim) { return claim ? Finding::holds : Finding::refuted; }
/// A number as the words on a finding show it, to `digits` significant digits.
[[nodiscard]] inline std::string number(double value, int digits = 5) { return significant(value, digits); }

/// One row of validation/evidence/checks.toml.
struct Check {
  std::string id;  ///< C1 … C20 claims, E1 … E11 errata, F7 … F24 figures, X… exact results, M… scenes, R… random, B…
                   ///< error bars, S… the discrete model in space
  std::string what;    ///< in a few words
  std::string claim;   ///< in full
  std::string number;  ///< which number is measured
  std::string unit;
  std::string oracle;               ///< closed form, 30-digit table, conservation law, other model, convergence
  std::string error;                ///< how the error is formed
  double seen = 0;                  ///< error when the tolerance was set; at least one unit in the last place
  double tolerance = 0;             ///< the error may be this; at most 5 × seen
  std::string reason;               ///< of the tolerance
  Finding answer = Finding::holds;  ///< expected
  bool quick = true;                ///< belongs to --quick
  std::optional<int> figure;
  std::string command;  ///< that shows the number
  /// An erratum has its equation or figure, what the paper prints there, the right form, and which number both give.
  std::string place{}, printed{}, right{}, compared{}, compared_unit{};
};

/// The table.  @throws std::runtime_error if it is not sound (an id twice, a tolerance above 5 × seen …).
[[nodiscard]] const std::vector<Check>& all_checks();

/// What a measurement found.
struct Measured {
  double number = 0;
  double error = 0;  ///< against the oracle
  Finding answer = Finding::holds;
  std::string found;                         ///< in words, with further numbers
  std::optional<double> printed{}, right{};  ///< of an erratum: what each form gives; none: no number, a sign say
};

/// The largest of the errors taken.  It is no number if none was taken or one is no number, so that no check passes on
/// nothing.
class WorstError {
 public:
  /// Whether an error is the worst so far.
  bool take(double error) {
    if (!(error > worst_) && !std::isnan(error)) return false;
    worst_ = error;
    return true;
  }
  [[nodiscard]] double value() const { return worst_ >= 0 ? worst_ : std::numeric_limits<double>::quiet_NaN(); }

 private:
  double worst_ = -1;
};
/// The largest of `errors`; no number if one is none.
[[nodiscard]] inline double worst_of(std::initializer_list<double> errors) {
  WorstError worst;
  for (const double error : errors) worst.take(error);
  return worst.value();
}

using Measure = std::function<Measured(CaseRuns&)>;
/// The measurement of each check, by its id.
using CheckMeasures = std::map<std::string, Measure>;

/// The measures of a group: claims C, errata E, exact results and tracked drops X, figures F, scenes M and R, error
/// bars B, the discrete model in space S.
[[nodiscard]] CheckMeasures claim_measures();
[[nodiscard]] CheckMeasures erratum_measures();
[[nodiscard]] CheckMeasures exact_measures();
[[nodiscard]] CheckMeasures figure_measures();
[[nodiscard]] CheckMeasures model_measures();
[[nodiscard]] CheckMeasures bar_measures();
[[nodiscard]] CheckMeasures space_measures();

/// Checks that were chosen.
struct CheckSelection {
  std::vector<const Check*> checks;  ///< in the order of the table
  std::string words;                 ///< "quick set: 77 checks of 78"
};

/// All checks; `quick`: without those that take long; or those named in `only`.
/// @throws BadInput for an unknown name, with the nearest, or if both are given.
[[nodiscard]] CheckSelection select_checks(bool quick, const std::vector<std::string>& only);

/// What became of a check.
struct CheckResult {
  const Check* check = nullptr;
  Measured measured{};
  double seconds = 0;     ///< processor time of the thread [s]; work shared with other checks falls to the first
  std::string failure{};  ///< why it failed; empty: passed
  bool done = false;      ///< false: an interrupt came first
  [[nodiscard]] bool passed() const { return done && failure.empty(); }
};

/// Runs `checks` with as many threads as the machine has; results in the order of the checks.
/// A check passes if its error is within the tolerance and the answer is the one that the table expects.
/// @param progress called with (done, of, id), from any thread but never at once; return false to end early.
[[nodiscard]] std::vector<CheckResult> verify_checks(
    const std::vector<const Check*>& checks, CaseRuns& case_runs,
    const std::function<bool(std::size_t, std::size_t, const std::string&)>& progress);

// What is said of a run: a table, and the results as one HTML page that needs nothing beside it.

/// Counts of a run.
struct VerifySummary {
  std::size_t passed = 0, failed = 0, not_run = 0;
  double seconds = 0;  ///< of all threads [s]
};
[[nodiscard]] VerifySummary summary_of(const std::vector<CheckResult>& results);
/// Exit status: 0 all passed, 1 a check failed, 130 interrupted.
[[nodiscard]] int verify_status(const VerifySummary& summary);
/// "75 of 75 checks passed; …".
[[nodiscard]] std::string summary_words(const VerifySummary& summary);

[[nodiscard]] std::vector<Column> verify_columns();
/// A row for each check.
[[nodiscard]] Report verify_report(const std::vector<CheckResult>& results, const std::string& selection);

/// The page: verdicts, and the figures that the checks belong to, redrawn from `case_runs` as inline SVG with the
/// command that reproduces each.  No script, no request to anywhere.
/// @throws std::runtime_error if gnuplot is not there or fails.
[[nodiscard]] std::string verify_page(const std::vector<CheckResult>& results, const std::string& selection,
                                      CaseRuns& case_runs);

// What checks refer to: tables that the program carries (30 digits of the thin rod's first three impacts, and others),
// the contact angles of the elastic rod, of which many claims and errata speak, and the folds at which its second and
// third impact end.

/// One row: column name → value rounded to double; columns with a gap are absent (this impact does not happen with a
/// contact angle up to 90°).
using ReferenceRow = std::map<std::string, double>;

/// The rows of validation/oracles/reference/NAME, if the program carries that.
[[nodiscard]] std::vector<oracle::ReferenceRow> reference_words(const std::string& name);

enum class ReferenceTable { no_gravity, gravity };

/// Columns theta_deg, G, beta_deg, gamma_deg, P1, P2, P3, V1, Omega1, V2, Omega2, V3, Omega3, T1, T2 for m = L = |v_n|
/// = 1.
[[nodiscard]] const std::vector<ReferenceRow>& reference_table(ReferenceTable table);

/// Contact angles of the elastic rod for θ in degrees; G = g L/v_n².
[[nodiscard]] inline analytic::ContactAngles elastic_angles(double degrees, double gravity_number = 0) {
  return contact_angles(analytic::Angle::from_degrees(degrees), {.gravity_number = gravity_number});
}

/// θ* at which the second impact ends, the other end grazing the ground: sin θ + K φ − sin(φ − θ) = 0 and cos(φ − θ) =
/// K with K = (1 − 3c²)/(6c), φ = θ + β (Eq. 12 and its derivative).  By bisection in long double.
[[nodiscard]] double second_impact_fold();
/// β* = arccos K there.
[[nodiscard]] double second_impact_fold_beta();
/// θ* at which the third impact ends [°], from an independent computation in 60 digits.
inline constexpr double third_impact_fold_deg = 27.577809606636;

}  // namespace clatter::validation
