// SPDX-License-Identifier: GPL-3.0-or-later
// The steps in which corners that stay on the ground begin to slip.
//
// While the slip σ of a corner is small its direction φ follows σ φ′ = g(φ) so fast that explicit steps fail: beside
// the direction φ₀ with g(φ₀) = 0, where σ = f t and φ₀ = φ₀(0) + φ₀′ t,
//     φ = φ₀ + σ φ₀′/(g_φ − f),   g_φ < 0,                                                               (1)
// and whatever is beside this solution goes away as t^(g_φ/f).  Velocities are smooth functions of time on it, from
// the moment when slip is zero on.  One step of radau_rule.hpp, implicit in the directions of all that slips, finds
// them without (1): at each point of the step slip has the direction in which friction acts against it.
#pragma once

#include <vector>

#include "analytic/space/impulse/radau_rule.hpp"
#include "analytic/space/sequence/ground_motion.hpp"
#include "analytic/space/sequence/slip_onset.hpp"

namespace clatter::analytic::space {

struct SlipStart {
  static constexpr int order = RadauRule::points;  ///< of `error` in the length of the step
  GroundMotion end;                                ///< the beginning, if no such step was found
  GroundMotion error;                              ///< an estimate; infinite, if no such step was found
  std::vector<GroundPoint> points;                 ///< with their directions at the end
  double stiffness = 0;  ///< largest rate at which a direction is driven back, or away, at the end [1/s]
};

/// @param points  none sticks, and some begin to slip
/// @param from  at which slip may be zero, or less by rounding
[[nodiscard]] SlipStart slip_start(const GroundLaw& law, const std::vector<GroundPoint>& points,
                                   const GroundMotion& from, double length, const MotionScale& scale);

}  // namespace clatter::analytic::space
