// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of `clatter benchmark list`, `show`, `truth` and `score`, and of `clatter compare --against`.
#pragma once

#include "validation/benchmark/submission.hpp"
#include "validation/output/picture.hpp"
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

// Reports on others' answers.

[[nodiscard]] std::vector<Column> score_columns();

/// One row per file; groups with their worst phase and order in words and JSON.
/// @param details  whether a reader sees all errors, causes and findings of several files, too, and not a line for each
[[nodiscard]] Report score_report(const std::string& command, const std::vector<Submission>& submissions, bool details);

/// A file that cannot be judged, and why.
struct UnreadFile {
  std::string path, reason;
};
/// Lists them below the others.
void add_unread(const std::vector<UnreadFile>& unread, Report& report);

/// Where files of a group differ in their step, the largest error over the step, a curve for each group, else that of
/// each impact, a curve for each file or, where they are many, for each group; with the classes of the first file's
/// problem.
[[nodiscard]] Picture score_picture(const std::vector<Submission>& submissions);

/// As score_report() of runs of a scene that has no certified answers: they are judged by the discrete model.
[[nodiscard]] Report against_report(const Scene& scene, const Reference& reference,
                                    const std::vector<Submission>& submissions, bool details);

/// What is asked of each file: a class, "good", or a largest error, "1e-3".
struct Requirement {
  std::optional<Verdict> verdict;
  std::optional<double> error;
  [[nodiscard]] bool is_met(const Submission& submission) const;
};
/// Whether it is met; says what misses: "FILE: coarse by t of impact 3, off by 0.0042; asked for good".
[[nodiscard]] bool meets(const Submission& submission, const Requirement& requirement);
/// @throws BadInput
[[nodiscard]] Requirement read_requirement(const std::string& name, const std::string& text);

}  // namespace clatter::validation
