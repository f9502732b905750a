// SPDX-License-Identifier: GPL-3.0-or-later
// The steps in which corners that stay on the ground begin to slip.
//
// While the slip σ of a corner is small its direction φ follows σ φ′ = g(φ) so fast that explicit steps fail: beside
// the direction φ₀ with g(φ₀) = 0, where σ = f t and φ₀ = φ₀(0) + φ₀′ t,
//     φ = φ₀ + σ φ₀′/(g_φ − f),   g_φ < 0,                                                               (1)
// and whatever is beside this solution goes away as t^(g_φ/f).  Velocities are smooth functions of time on it, from
// the moment when slip is zero on.  One step of Radau's rule, implicit in the directions of all that slips, finds
// them without (1): at each point of the step slip has the direction in which friction acts against it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analytic/space/sequence/ground_forces.hpp"

namespace clatter::analytic::space {

// How slip begins at corners that stay on the ground and stuck.
//
// Where friction gives way, slip grows from zero, in the directions of the friction that held the corners.  The
// directions φ_i and speeds σ_i obey
//     σ_i φ_i′ = g_i(φ),   g_i the acceleration of corner i across its slip,                            (1)
// which is stiff while σ is small, and where slip that leaves g = 0 is driven back there has one solution that begins
// at rest, with g(φ₀) = 0 (slip_start()).  An edge one corner of which sticks lets the other slip across it only,
// either way.

/// Directions of the corners that turning_points() names [rad].
using SlipAngles = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2, 1>;

/// The corners that begin to slip in a direction that nothing but (1) says.
[[nodiscard]] std::vector<std::size_t> turning_points(std::span<const GroundPoint> points);

/// The points with these directions of slip.
[[nodiscard]] std::vector<GroundPoint> directed(std::vector<GroundPoint> points, const SlipAngles& angles);

/// The angles with g = target, near those of the points; NaN where there are none.
[[nodiscard]] SlipAngles slip_angles(const GroundLaw& law, const State& s, const std::vector<GroundPoint>& points,
                                     const SlipAngles& target);

/// The points where friction has just given way, with the directions in which they begin to slip; nothing where slip
/// would not be driven back to g = 0.
/// @param slow  slip of other corners below which it is rounding, and begins, too [m/s]
[[nodiscard]] std::optional<std::vector<GroundPoint>> give_way(const GroundLaw& law, const State& s,
                                                               std::vector<GroundPoint> points, double slow);

/// All ways in which corners that stick where friction does not hold them can begin to slip: those that do accelerate
/// along their slip, the others are held.
[[nodiscard]] std::vector<std::vector<GroundPoint>> ways_to_slip(const GroundLaw& law, const State& s,
                                                                 const std::vector<GroundPoint>& points);

struct SlipStart {
  static constexpr int order = 6;   ///< of `error` in the length of the step
  GroundMotion end;                 ///< the beginning, if no such step was found
  GroundMotion error;               ///< an estimate; infinite, if no such step was found
  std::vector<GroundPoint> points;  ///< with their directions at the end
  double stiffness = 0;             ///< largest rate at which a direction is driven back, or away, at the end [1/s]
};

/// @param points  none sticks, and some begin to slip
/// @param from  at which slip may be zero, or less by rounding
[[nodiscard]] SlipStart slip_start(const GroundLaw& law, const std::vector<GroundPoint>& points,
                                   const GroundMotion& from, double length, const MotionScale& scale);

}  // namespace clatter::analytic::space
