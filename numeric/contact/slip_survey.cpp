// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/slip_survey.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::numeric {

SlipSurvey survey(const SlipPatch& patch) {
  SlipSurvey s;
  PlanePoint low = patch.corners[0], high = low;
  for (int i = 1; i < patch.count; ++i) {
    const PlanePoint& p = patch.corners[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  s.middle = between(low, high, 0.5);
  s.slip = slip_at(patch, s.middle);
  double square = 0, variation = 0;
  for (int i = 0; i < patch.count; ++i) {
    const PlanePoint away = minus(patch.corners[i], s.middle);
    const SlipVector change{patch.east.along(away), patch.north.along(away)};
    square = std::max(square, away.x * away.x + away.y * away.y);
    variation = std::max(variation, change.square());
  }
  s.size = std::sqrt(square);
  s.variation = std::sqrt(variation);
  s.fastest = std::sqrt(s.slip.square()) + s.variation;
  return s;
}

}  // namespace clatter::numeric
