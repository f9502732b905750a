// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter measured` is asked for, read and fitted; its reports and its picture.
#pragma once

#include "validation/measured/score.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/scene/argument.hpp"

namespace clatter::validation {

/// What a command of `measured` works on.
struct MeasuredRun {
  MeasuredFile file;
  TrackSplit split;
  MeasuredFit fit;
  std::string split_words;  ///< how the drops were shared out
};

struct MeasuredRequest {
  std::string file;             ///< poses, or the name of a data set that comes with the program
  std::string body;             ///< what was tracked; empty: as a file beside it says
  std::optional<int> seed;      ///< of the drops that are drawn to fit on
  std::optional<double> share;  ///< of them
  std::string fit_on;           ///< or a list of them
  std::string fit_from;         ///< or another file, all of which is fitted on
};
/// All but the file.
[[nodiscard]] Arguments measured_arguments(MeasuredRequest& request);

/// The tracks, taken apart, and the laws fitted to a part of them.
/// @throws BadInput naming the option or the file.
[[nodiscard]] MeasuredRun read_measured_run(const MeasuredRequest& request);

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
