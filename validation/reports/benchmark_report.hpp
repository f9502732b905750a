// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of `clatter benchmark list`, `show` and `truth`, and on others' answers: of `clatter benchmark score` and
// `clatter compare --against`.
#pragma once

#include "validation/benchmark/problem.hpp"
#include "validation/benchmark/submission.hpp"
#include "validation/figures/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline reports {

[[nodiscard]] std::vector<Column> benchmark_list_columns();
[[nodiscard]] std::vector<Column> benchmark_truth_columns();

[[nodiscard]] Report benchmark_list_report();
/// A line per problem, its ID first.
[[nodiscard]] std::string benchmark_list_text();
/// The statement in the form of the IFToMM library of computational benchmark problems: motivation, data, what is
/// asked, error, acceptance, results.
[[nodiscard]] Report benchmark_statement(const Problem& problem);
/// The same with its head as paragraphs and lists of Markdown.
[[nodiscard]] Report markdown_statement(const Problem& problem);
/// The truth by `law`, in columns that `clatter benchmark score` reads.
[[nodiscard]] Report benchmark_truth_report(const Problem& problem, const std::string& law);

[[nodiscard]] std::vector<Column> score_columns();

/// One row per file; groups with their worst phase and order in words and JSON.
[[nodiscard]] Report score_report(const std::string& command, const std::vector<Submission>& submissions);

/// The largest error of each impact, a curve for each file, with the classes of the first file's problem.
[[nodiscard]] Picture score_picture(const std::vector<Submission>& submissions);

/// The same of runs of a scene that has no certified answers: they are judged by the discrete model.
[[nodiscard]] Report against_report(const Scene& scene, const Reference& reference,
                                    const std::vector<Submission>& submissions);

/// A vector as a list of its parts.
[[nodiscard]] std::vector<double> parts(const analytic::space::Vector3& v);

/// What is asked of each file: a class, "good", or a largest error, "1e-3".
struct Requirement {
  std::optional<Verdict> verdict;
  std::optional<double> error;
  [[nodiscard]] bool is_met(const Submission& submission) const;
};
/// @throws BadInput
[[nodiscard]] Requirement read_requirement(const std::optional<std::string>& text);

}  // namespace clatter::validation::inline reports
