// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of `clatter benchmark list`, `show` and `truth`.
#pragma once

#include "analytic/space/flight/body.hpp"
#include "validation/benchmark/reference.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> benchmark_list_columns();
[[nodiscard]] std::vector<Column> benchmark_truth_columns();

[[nodiscard]] Report benchmark_list_report();
/// A line per problem, its ID first.
[[nodiscard]] std::string benchmark_list_text();
/// The statement in the form of the IFToMM library of computational benchmark problems: motivation, data, what is
/// asked, error, acceptance, results.
[[nodiscard]] Report benchmark_statement(const Problem& problem);
/// The same with its head as paragraphs and blocks of Markdown.
[[nodiscard]] Report markdown_statement(const Problem& problem);
/// The truth by `law`, in columns that `clatter benchmark score` reads.
[[nodiscard]] Report benchmark_truth_report(const Problem& problem, const std::string& law);

/// A vector as a list of its parts.
[[nodiscard]] std::vector<double> parts(const analytic::space::Vector3& v);

}  // namespace clatter::validation
