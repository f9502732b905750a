// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter explain` says: an explanation as text, Markdown, LaTeX, CSV and JSON, each written from its structure.
#pragma once

#include <string>
#include <vector>

#include "validation/explain/explanation.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> explain_columns();
/// All of its JSON.  Of an equation: `symbolic` and `numeric` are text, `tex` is lines of an aligned environment; the
/// value of a vector is a list of its components, of a matrix a list of its rows.
[[nodiscard]] Value explanation_fields(const Explanation& explanation);
/// A row for each equation, of a vector or matrix for each component.
[[nodiscard]] Report explanation_report(const Explanation& explanation);
/// In any format: tables, Markdown and LaTeX have the steps as text with equations.
[[nodiscard]] std::string explanation_text(const Explanation& explanation, const TextStyle& style);

}  // namespace clatter::validation
