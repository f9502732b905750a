// SPDX-License-Identifier: GPL-3.0-or-later
// A logarithmic difference that keeps its relative accuracy for small arguments.
#pragma once

namespace clatter::analytic::detail {

/// ln(1+x) − x for x > −1: by Boost's series where the difference would cancel.  Accuracy: 2 ulp.
[[nodiscard]] double log1p_minus(double x);

}  // namespace clatter::analytic::detail
