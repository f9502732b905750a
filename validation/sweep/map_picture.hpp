// SPDX-License-Identifier: GPL-3.0-or-later
// A map as a picture, or as an array.
#pragma once

#include <string>
#include <vector>

#include "validation/sweep/map_plan.hpp"

namespace clatter::validation {

/// The pixels of a map, row by row from below, as they came.
struct MapImage {
  std::vector<std::vector<MapPixel>> rows;

  [[nodiscard]] long long open() const;
  /// Pixels whose drop is refused, outside the model or not computed.
  [[nodiscard]] long long without_drop() const;
};

/// Where the thin rod's second and third impacts end, as curves: regime_boundary() at values of the other axis.
struct FoldCurve {
  std::string name;
  std::vector<std::array<double, 2>> points;  ///< x, y; not finite: a gap
};
/// Empty where no axis is drop.angle_deg, or the body is no thin rod that falls without spin.
[[nodiscard]] std::vector<FoldCurve> fold_curves(const MapPlan& plan);

/// PNG.  @throws as run_gnuplot.
[[nodiscard]] std::string map_picture(const MapPlan& plan, const MapImage& image);
/// NumPy's format: an array of rows of numbers (counts are numbers too: infinite ones inf, no such drop nan), or of the
/// classes' names, "open" where that is left open; with samples three of them: probability, low, high.
[[nodiscard]] std::string map_array(const MapPlan& plan, const MapImage& image);

}  // namespace clatter::validation
