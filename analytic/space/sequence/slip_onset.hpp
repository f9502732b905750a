// SPDX-License-Identifier: GPL-3.0-or-later
// How slip begins at corners that stay on the ground and stuck.
//
// Where friction gives way, slip grows from zero, in the directions of the friction that held the corners.  The
// directions φ_i and speeds σ_i obey
//     σ_i φ_i′ = g_i(φ),   g_i the acceleration of corner i across its slip,                            (1)
// which is stiff while σ is small, and where slip that leaves g = 0 is driven back there has one solution that begins
// at rest, with g(φ₀) = 0 (slip_start.hpp).  An edge one corner of which sticks lets the other slip across it only,
// either way.
#pragma once

#include <optional>
#include <vector>

#include "analytic/space/sequence/ground_forces.hpp"

namespace clatter::analytic::space {

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

}  // namespace clatter::analytic::space
