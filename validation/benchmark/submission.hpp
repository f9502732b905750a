// SPDX-License-Identifier: GPL-3.0-or-later
// Files with answers of others: read, judged, and put together by problem.
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "validation/benchmark/cause.hpp"
#include "validation/output/estimated.hpp"

namespace clatter::validation {

/// Lines above a file's header, "# key: value"; the problem alone is required, and not even that where a scene is
/// given.
struct SubmissionHead {
  std::string problem, engine, version, settings;
  std::string law{};           ///< as DeclaredLaw::name; empty: not declared
  std::optional<double> step;  ///< of the code [s]

  /// What files of one group have alike.
  [[nodiscard]] auto group() const { return std::tie(problem, engine, version, settings, law); }
};

/// What is said in place of a cause where impacts break the law and none explains that.
inline constexpr const char* unexplained_law = "law unexplained";

/// A file and how it does.
struct Submission {
  std::string path;
  std::string name{};  ///< the file's, for readers; name_apart()
  SubmissionHead head;
  std::string asked{};             ///< the problem's ID, or the scene's file
  std::vector<double> tolerances;  ///< of the classes, there
  int problem_version = 0;
  bool is_list = false;    ///< of impacts, not a motion
  bool gradients = false;  ///< with derivatives
  Score score{};
  Verdict verdict = Verdict::fails;
  std::vector<Cause> causes{};      ///< what explains a run that is not sharp
  bool law_is_unexplained = false;  ///< Diagnosis::law_is_unexplained
};

/// Files of one problem, engine, version, settings and law.
struct SubmissionGroup {
  struct Step {
    std::optional<double> step;                         ///< [s]
    std::size_t files = 0;                              ///< phases: starting gaps
    double motion_error = 0, law_error = 0, error = 0;  ///< of the worst phase; infinite: not known
    std::vector<double> motion_errors{};                ///< of each phase
    Verdict verdict = Verdict::exact;                   ///< of the worst phase
  };
  SubmissionHead head;
  std::vector<Step> steps;  ///< the longest first
  /// The order of V, Ω and t in the step, by least squares over the steps at which all impacts are right, of the mean
  /// over the phases: where in a step a touch falls is chance, and the errors of first order that it makes lie anywhere
  /// between none and those of a whole step.  Nothing for fewer than two steps.  The error is an estimate, NaN for
  /// fewer than three steps: the largest of those by the fit, by leaving out a step at a time (jackknife), and by the
  /// scatter of the phases.
  std::optional<Estimated> order;
  Verdict verdict = Verdict::exact;  ///< of the worst file
  std::size_t files = 0, incomplete = 0;
  /// A cause, in how many files it was found, and in how many it is the first.
  struct CauseCount {
    std::string name;
    std::size_t files = 0, leads = 0;
  };
  std::vector<CauseCount> causes{};  ///< the one of most files first, of these that which is most often the first
  double unexplained = 0;            ///< Cause::unexplained of the worst file; infinite: not known of each
};

/// "newton routh", "poisson, routh", "moreau", … as DeclaredLaw::name.  @throws BadInput beginning with `where`
[[nodiscard]] std::string read_law(const std::string& where, const std::string& text);

/// Judges a file by its problem.
/// @param problem in place of the file's own line; empty: none
/// @throws BadInput "FILE:LINE:COLUMN: …"
[[nodiscard]] Submission judge_file(const std::string& path, const std::string& problem, const ColumnNames& names);
/// Judges a file by a scene.
[[nodiscard]] Submission judge_file(const std::string& path, const Reference& reference, const ColumnNames& names);

/// Gives files of one name the folders by which they differ.
void name_apart(std::vector<Submission>& submissions);

/// @param submissions in any order
[[nodiscard]] std::vector<SubmissionGroup> group_submissions(const std::vector<Submission>& submissions);

}  // namespace clatter::validation
