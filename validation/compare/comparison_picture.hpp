// SPDX-License-Identifier: GPL-3.0-or-later
// A comparison of both models as a picture.
#pragma once

#include <vector>

#include "validation/compare/swept_comparison_report.hpp"
#include "validation/output/picture.hpp"

namespace clatter::validation {

/// Normal impulses over the number of the impact, and how far each impact's worst number deviates.
[[nodiscard]] Picture comparison_picture(const Scene& scene, const Comparison& comparison);

/// The same of the first impact over the swept value.
[[nodiscard]] Picture swept_comparison_picture(const Scene& scene, const std::vector<SweptComparison>& swept);

}  // namespace clatter::validation
