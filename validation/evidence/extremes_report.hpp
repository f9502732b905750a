// SPDX-License-Identifier: GPL-3.0-or-later
// The map of extremes as a report and as a picture.
#pragma once

#include <string>
#include <vector>

#include "validation/evidence/extremes.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> extremes_columns();
/// A row for each cell; tables have one for each region, and the reasons of refusals as notes.
[[nodiscard]] Report extremes_report(const ExtremesMap& map);
/// SVG: a strip for each quantity and model, its values side by side, coloured by digits, refusals hatched.
[[nodiscard]] std::string extremes_picture(const ExtremesMap& map);

}  // namespace clatter::validation
