// SPDX-License-Identifier: GPL-3.0-or-later
// Reports on others' answers: of `clatter benchmark score` and `clatter compare --against`.
#pragma once

#include "validation/benchmark/submission.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> score_columns();

/// One row per file; groups with their worst phase and order in words and JSON.
/// @param details  whether a reader sees all errors, causes and findings of several files, too, and not a line for each
[[nodiscard]] Report score_report(const std::string& command, const std::vector<Submission>& submissions, bool details);

/// Where files of a group differ in their step, the largest error over the step, a curve for each group, else that of
/// each impact, a curve for each file; with the classes of the first file's problem.
[[nodiscard]] Picture score_picture(const std::vector<Submission>& submissions);

/// The same of runs of a scene that has no certified answers: they are judged by the discrete model.
[[nodiscard]] Report against_report(const Scene& scene, const Reference& reference,
                                    const std::vector<Submission>& submissions);

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
