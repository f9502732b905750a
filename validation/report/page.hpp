// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a report.
#pragma once

#include <string>
#include <vector>

#include "validation/report/cases.hpp"

namespace clatter::validation {

/// HTML with all that it shows in itself.
/// @param first  the case that was given first, whose title the page has where none was given
/// @param order  all, the worst first
/// @param report  of all
/// @param lack  what of what was asked for is not there, which stands above all; empty: nothing
/// @param is_short  it has the answers, the table of cases and a drawing of each worst drop alone
/// @throws as run_gnuplot
[[nodiscard]] std::string page_of(const ReportCase& first, const std::vector<const ReportCase*>& order,
                                  const Report& report, const Attitudes& attitudes, bool is_short,
                                  const std::string& lack);

}  // namespace clatter::validation
