// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter compare` says of a swept scene.
#pragma once

#include <vector>

#include "validation/compare/comparison_report.hpp"

namespace clatter::validation {

/// The number of an impact that deviates most for its size: deviation over scale, its error and what was predicted of
/// it; the number whose limit is farthest off for what it may be: distance over scale, and its error bar.
struct WorstNumber {
  double deviation = 0, deviation_error = 0, predicted = 0, miss = 0, miss_error = 0, bar = 0;
};
/// The worst number of an impact that the discrete model has.
[[nodiscard]] WorstNumber worst_number(const Comparison& comparison, const ComparedImpact& impact);

/// One value of a swept scene.
struct SweptComparison {
  double value;
  Comparison comparison;
};
/// A row for each value, impact and number; in tables the worst number of each impact.
[[nodiscard]] Report swept_comparison_report(const Scene& scene, const std::vector<SweptComparison>& swept);

}  // namespace clatter::validation
