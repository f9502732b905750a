// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace clatter::validation::inline measured {

/// Ends of the ranges of the angle between arm and vertical [°] by which scores and extremes list measured drops.
inline constexpr double arm_angle_edges[] = {0, 10, 20, 25, 30, 35, 40, 60};

}  // namespace clatter::validation::inline measured
