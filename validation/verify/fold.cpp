// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/verify/fold.hpp"

#include <cmath>

namespace clatter::validation::inline verify {
namespace {

long double slope(long double theta) {
  const long double c = std::cos(theta);
  return (1 - 3 * c * c) / (6 * c);
}

/// Height of the grazing end at its lowest point; negative: it strikes.
long double clearance(long double theta) {
  const long double k = slope(theta), beta = std::acos(k);
  return std::sin(theta) + k * (theta + beta) - std::sin(beta);
}

long double fold() {
  long double low = 1.0L, high = 1.03L;  // 57.3° … 59.0°
  for (int i = 0; i < 80; ++i) {
    const long double middle = (low + high) / 2;
    (clearance(middle) < 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

double second_impact_fold() { return static_cast<double>(fold()); }

double second_impact_fold_beta() { return static_cast<double>(std::acos(slope(fold()))); }

}  // namespace clatter::validation::inline verify
