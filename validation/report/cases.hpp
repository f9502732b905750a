// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of a report on several scenes, values of flags and parts, and the table that has a row for each.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/report/findings.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {

/// One scene with one value of each flag and at most one part.
struct ReportCase {
  ReportInput input;
  std::vector<std::pair<const Key*, std::string>> varied;  ///< keys of which other cases have other values, and its own
  ShockView view;
  bool is_turned = false;  ///< whether the input says how the body is turned
  Scene given{};
  bool names_scene = false;               ///< whether scenes are several
  std::string part_name{};                ///< "camera", or "a part of 500 Hz that bears 300 g"; empty: no part
  std::vector<FragilePart> swept_with{};  ///< parts that share its drops in all attitudes
  bool begins_sweep = false;              ///< whether it is the first of those
  Findings found{};

  /// File or name of its scene.
  [[nodiscard]] std::string scene() const;
  /// "pad, wood, e = 0.3, sliding friction 0.3": what of it differs from other cases, but the part.
  [[nodiscard]] std::string name() const;
  /// "pad, e = 0.3: camera survives".
  [[nodiscard]] std::string heading() const;
  /// The restitution that was given for the model that runs; none: another number says it, or none does.
  [[nodiscard]] std::optional<double> given_restitution() const;
  [[nodiscard]] double value() const {
    return found.answer.blow ? found.answer.blow->value : std::numeric_limits<double>::quiet_NaN();
  }
};

/// Every scene with every value of the flags that have several, and every part.
/// @throws BadInput for values that are none, and for more than 100 cases
[[nodiscard]] std::vector<ReportCase> cases_of(const ReportInput& given);

/// The cases by how hard they are, the worst first: those with a margin before those without a limit, and these before
/// those ranked by a peak or a change of velocity.
[[nodiscard]] std::vector<const ReportCase*> ranked(const std::vector<ReportCase>& cases);

/// The cases that are the worst of their scene and floor or of their part, in the order of the cases.
[[nodiscard]] std::vector<const ReportCase*> worst_cases(const std::vector<const ReportCase*>& order);

/// Each part's answer in a sentence, the worst part first.
[[nodiscard]] std::vector<std::string> part_answers(const std::vector<const ReportCase*>& order);

/// One report of several cases: the fields of the worst, and all in a table, or the attitudes of each.
[[nodiscard]] Report joined_report(const std::vector<const ReportCase*>& order);

/// A row for each case, in their order.
[[nodiscard]] Grid cases_grid(const std::vector<const ReportCase*>& cases);
/// The attitudes of cases, each row behind what tells its case from others.  @throws BadInput for a body without them
[[nodiscard]] Grid attitudes_of_cases(const std::vector<const ReportCase*>& cases);
[[nodiscard]] std::vector<Column> case_attitude_columns();

/// The columns of a table of several cases.
[[nodiscard]] std::vector<Column> case_columns();

}  // namespace clatter::validation
