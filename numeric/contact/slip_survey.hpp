// SPDX-License-Identifier: GPL-3.0-or-later
// What slip_integrals must know of a polygon to choose among its ways.
#pragma once

#include "numeric/contact/slip_segment.hpp"

namespace clatter::numeric {

[[nodiscard]] inline double cross(const PlanePoint& a, const PlanePoint& b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline PlanePoint minus(const PlanePoint& a, const PlanePoint& b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline PlanePoint between(const PlanePoint& a, const PlanePoint& b, double part) {
  return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}
[[nodiscard]] inline SlipVector slip_at(const SlipPatch& patch, const PlanePoint& p) {
  return {patch.east.at(p), patch.north.at(p)};
}

struct SlipSurvey {
  PlanePoint middle;                  ///< of the polygon's bounding box
  double size = 0;                    ///< largest distance of a corner from the middle [m]
  SlipVector slip;                    ///< at the middle
  double variation = 0, fastest = 0;  ///< of the slip from that, and itself [m/s]
};

/// Of a patch with corners.
[[nodiscard]] SlipSurvey survey(const SlipPatch& patch);

}  // namespace clatter::numeric
