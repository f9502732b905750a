// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter explain` says.
#pragma once

#include <string>

#include "validation/output/report.hpp"
#include "validation/reports/derivation.hpp"

namespace clatter::validation::inline reports {

[[nodiscard]] std::vector<Column> explain_columns();
/// A row for each equation.
[[nodiscard]] Report explanation_report(const Explanation& explanation);
/// In any format: tables, Markdown and LaTeX have the steps as text with equations.
[[nodiscard]] std::string explanation_text(const Explanation& explanation, const TextStyle& style);

}  // namespace clatter::validation::inline reports
