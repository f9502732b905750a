// SPDX-License-Identifier: GPL-3.0-or-later
// Fewer points that draw the same curve.
#pragma once

#include <vector>

namespace clatter::validation::inline figures {

/// A point of a curve; not finite: a gap.
struct CurvePoint {
  double x = 0, y = 0;
  double low = 0;               ///< lower end of an area, else 0
  double x_end = 0, y_end = 0;  ///< other end of a segment, else 0
  [[nodiscard]] bool is_gap() const;
};

/// Curves up to this length are drawn whole.
inline constexpr std::size_t whole_curve = 4000;

/// A longer curve: its range in x is cut into a thousand strips, narrower than a pixel.  Of the points that run through
/// a strip one after the other only the first, the last, the highest and the lowest stay, in their order.  A gap ends
/// such a run, so that both ends of each branch stay, and peaks however narrow.
[[nodiscard]] std::vector<CurvePoint> thinned(const std::vector<CurvePoint>& points);

}  // namespace clatter::validation::inline figures
