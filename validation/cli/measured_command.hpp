// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter measured` is asked for, read and fitted.
#pragma once

#include <optional>
#include <string>

#include "validation/reports/measured_report.hpp"

namespace clatter::validation::inline cli {

/// Texts as given; each is checked when it is read.
struct MeasuredRequest {
  std::string file;                        ///< poses, or the name of a data set that comes with the program
  std::optional<std::string> body;         ///< what was tracked
  std::optional<std::string> seed, share;  ///< of the drops that are drawn to fit on
  std::optional<std::string> fit_on;       ///< or a list of them
  std::optional<std::string> fit_from;     ///< or another file, all of which is fitted on
};

/// The tracks, taken apart, and the laws fitted to a part of them.
/// @throws BadInput naming the option or the file.
[[nodiscard]] MeasuredRun read_measured_run(const MeasuredRequest& request);

}  // namespace clatter::validation::inline cli
