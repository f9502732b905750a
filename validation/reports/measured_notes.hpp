// SPDX-License-Identifier: GPL-3.0-or-later
// What the reports of `clatter measured` have in common.
#pragma once

#include "validation/reports/measured_report.hpp"

namespace clatter::validation::inline reports {

/// A report with what every one of a run carries: its head, the data, the split, the calibration.
[[nodiscard]] Report begun(const MeasuredRun& run, const std::string& action, const std::string& what);
/// What the frames and flights say of themselves.
[[nodiscard]] std::vector<std::string> track_notes(const MeasuredRun& run);
/// The calibration in words.
[[nodiscard]] std::string calibration_note(const MeasuredRun& run);
/// "poisson, e = 0.47, μ = 0.097".
[[nodiscard]] std::string law_words(const FittedLaw& law);

}  // namespace clatter::validation::inline reports
