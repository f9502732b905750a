// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of a report on several floors, restitutions and parts, and the table that has a row for each.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "validation/report/findings.hpp"

namespace clatter::validation {

struct ReportCase {
  ReportInput input;
  std::string restitution;  ///< empty: not ranged over
  ShockView view;
  bool is_turned = false;  ///< whether the input says how the body is turned
  Scene given{};
  Findings found{};

  [[nodiscard]] std::string floor() const {
    const std::string& source = input.scene.source;
    return source.empty() ? "the drop" : source.substr(0, source.size() - (source.ends_with(".toml") ? 5 : 0));
  }
  /// "pad, e = 0.3, 500:300".
  [[nodiscard]] std::string name() const {
    const auto part = input.part();
    return floor() + (restitution.empty() ? "" : ", e = " + restitution) + (part ? ", " + part_text(*part) : "");
  }
  [[nodiscard]] double value() const {
    return found.answer.blow ? found.answer.blow->value : std::numeric_limits<double>::quiet_NaN();
  }
};

[[nodiscard]] std::vector<ReportCase> cases_of(const ReportInput& given);

/// The cases by how hard they are, the worst first, where one thing ranks all of them.
[[nodiscard]] std::vector<const ReportCase*> ranked(const std::vector<ReportCase>& cases);

/// The worst case of each floor, in the order of the cases.
[[nodiscard]] std::vector<const ReportCase*> worst_of_floors(const std::vector<const ReportCase*>& order);

/// One report of several cases: the fields of the worst, and all in a table.
[[nodiscard]] Report joined_report(const std::vector<const ReportCase*>& order);

/// The columns of a table of several cases.
[[nodiscard]] std::vector<Column> case_columns();

}  // namespace clatter::validation
