// SPDX-License-Identifier: GPL-3.0-or-later
// Reports and the picture of `clatter measured`.
#pragma once

#include "validation/measured/score.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

/// What a command of `measured` works on.
struct MeasuredRun {
  MeasuredFile file;
  TrackSplit split;
  MeasuredFit fit;
  std::string split_words;  ///< how the drops were shared out
};

[[nodiscard]] std::vector<Column> measured_fit_columns();
[[nodiscard]] std::vector<Column> measured_predict_columns();
[[nodiscard]] std::vector<Column> measured_score_columns();

[[nodiscard]] Report measured_fit_report(const MeasuredRun& run);
[[nodiscard]] Report measured_predict_report(const MeasuredRun& run, const Scores& scores);
[[nodiscard]] Report measured_score_report(const MeasuredRun& run, const Scores& scores);

/// A drop's measured heights and predicted sequence, errors by angle, and how many numbers lie within their intervals.
/// @param drop  its name; empty: the first point impact that was scored
/// @throws BadInput if there is no such drop among those scored.
[[nodiscard]] Picture measured_picture(const MeasuredRun& run, const Scores& scores, const std::string& drop);
/// Head of the picture's script.
[[nodiscard]] std::vector<std::string> measured_words(const MeasuredRun& run);

}  // namespace clatter::validation
