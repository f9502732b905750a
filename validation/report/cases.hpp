// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of a report on several floors, restitutions and parts, and the table that has a row for each.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "validation/report/findings.hpp"

namespace clatter::validation {

/// One scene with one restitution and at most one part.
struct ReportCase {
  ReportInput input;
  std::string restitution;  ///< empty: not ranged over
  ShockView view;
  bool is_turned = false;  ///< whether the input says how the body is turned
  Scene given{};
  bool names_floor = false;  ///< whether scenes are several
  Findings found{};

  [[nodiscard]] std::string floor() const {
    const std::string& source = input.scene.source;
    return source.empty() ? "the drop" : source.substr(0, source.size() - (source.ends_with(".toml") ? 5 : 0));
  }
  /// "pad, e = 0.3, 500:300": what of it differs from other cases.
  [[nodiscard]] std::string name() const;
  /// "pad, e = 0.3: a part of 500 Hz that bears 300 g survives".
  [[nodiscard]] std::string heading() const;
  /// The restitution that was given for the model that runs; none: another number says it, or none does.
  [[nodiscard]] std::optional<double> given_restitution() const;
  [[nodiscard]] double value() const {
    return found.answer.blow ? found.answer.blow->value : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  [[nodiscard]] std::string name(const std::string& of_part, const char* between) const;
};

[[nodiscard]] std::vector<ReportCase> cases_of(const ReportInput& given);

/// The cases by how hard they are, the worst first: those with a margin before those ranked by a peak, and these before
/// those by a change of velocity.
[[nodiscard]] std::vector<const ReportCase*> ranked(const std::vector<ReportCase>& cases);

/// The cases that are the worst of their floor or of their part, in the order of the cases.
[[nodiscard]] std::vector<const ReportCase*> worst_cases(const std::vector<const ReportCase*>& order);

/// One report of several cases: the fields of the worst, and all in a table, or the attitudes of each.
[[nodiscard]] Report joined_report(const std::vector<const ReportCase*>& order);

/// A row for each case, in their order.
[[nodiscard]] Grid cases_grid(const std::vector<const ReportCase*>& cases);
/// The attitudes of cases, each row behind what tells its case from others.  @throws BadInput for a body without them
[[nodiscard]] Grid attitudes_of_cases(const std::vector<const ReportCase*>& cases);
[[nodiscard]] std::vector<Column> case_attitude_columns();
/// What of the ground stays though e is ranged over; empty: nothing.
[[nodiscard]] std::string fixed_words(const std::vector<const ReportCase*>& cases);

/// The columns of a table of several cases.
[[nodiscard]] std::vector<Column> case_columns();

}  // namespace clatter::validation
