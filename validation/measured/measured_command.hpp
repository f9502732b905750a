// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter measured` is asked for, read and fitted.
#pragma once

#include <optional>
#include <string>

#include "validation/measured/measured_report.hpp"
#include "validation/scene/argument.hpp"

namespace clatter::validation {

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

}  // namespace clatter::validation
