// SPDX-License-Identifier: GPL-3.0-or-later
// Cost against error as a report and as a picture.
#pragma once

#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/plan/tradeoff.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> tradeoff_columns();
/// A row for each point; in tables the front, which nothing beats in both cost and error.
[[nodiscard]] Report tradeoff_report(const Scene& scene, const Tradeoff& tradeoff);
/// Error over cost, one curve for each model and method.
[[nodiscard]] Picture tradeoff_picture(const Scene& scene, const Tradeoff& tradeoff);

}  // namespace clatter::validation
