// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a report.
#pragma once

#include <string>
#include <vector>

#include "validation/report/cases.hpp"

namespace clatter::validation {

/// HTML with all that it shows in itself.  @throws as run_gnuplot
[[nodiscard]] std::string page_of(const std::vector<ReportCase>& cases, const Attitudes& attitudes);

}  // namespace clatter::validation
