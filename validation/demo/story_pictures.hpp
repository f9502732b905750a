// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of the page's story, as SVG elements that stand in HTML.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analytic/base/angle.hpp"

namespace clatter::validation::inline demo {

/// A blow on an end of the rod.
struct RodBlow {
  analytic::Angle angle;  ///< between rod and ground
  bool is_left = true;    ///< the left end strikes, else the right one
  double impulse = 0;     ///< [N·s]
  double strongest = 1;   ///< of the story, for the length of the arrow [N·s]
  std::string words;      ///< what the picture shows, for those who do not see it
};
[[nodiscard]] std::string rod_picture(const RodBlow& blow);

struct CurvePoint {
  double x = 0, y = 0;
};
struct Curve {
  std::vector<CurvePoint> points;
  std::string colour;
  bool is_dashed = false;
  std::string name;      ///< stands at its last point
  bool is_fold = false;  ///< its last point is marked by a circle
};
struct CurvePicture {
  std::vector<Curve> curves;
  double x_end = 90, y_end = 90;  ///< the axes begin at 0
  std::array<std::string, 2> axes;
  std::string words;
};
[[nodiscard]] std::string curve_picture(const CurvePicture& picture);

struct Bar {
  double value = 0;
  std::string name;
};
[[nodiscard]] std::string bar_picture(const std::vector<Bar>& bars, const std::string& words);

}  // namespace clatter::validation::inline demo
