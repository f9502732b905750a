// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a report.
#pragma once

#include <string>
#include <vector>

#include "validation/report/cases.hpp"

namespace clatter::validation {

/// HTML with all that it shows in itself.
/// @param is_short  it has the answers, the table of cases and a drawing of each worst drop alone
/// @throws as run_gnuplot
[[nodiscard]] std::string page_of(const std::vector<ReportCase>& cases, const Attitudes& attitudes, bool is_short);

}  // namespace clatter::validation
