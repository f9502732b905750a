// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter shock` says and draws.
#pragma once

#include <optional>
#include <vector>

#include "validation/figures/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation::inline reports {

/// A row for each impact and probe.
[[nodiscard]] std::vector<Column> shock_columns();
/// A row for each frequency of each spectrum.
[[nodiscard]] std::vector<Column> spectrum_columns();

/// @param spectrum  rows are those of the spectra in place of the impacts; JSON has both
/// @param severity  pseudo-velocity with which those of the spectra are compared [m/s]
[[nodiscard]] Report shock_report(const ShockRun& run, bool spectrum, std::optional<double> severity);
/// The spectra of pseudo-velocity, a panel for each probe.
[[nodiscard]] Picture shock_picture(const ShockRun& run, std::optional<double> severity);

}  // namespace clatter::validation::inline reports
