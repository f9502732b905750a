// SPDX-License-Identifier: GPL-3.0-or-later
// A pad's curve, as data sheets have it, and the ground that it makes.
#pragma once

#include <string>

#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// Reads the curve's file, if it has one, and turns the curve to the SI's units.
/// @throws BadInput naming file and line, or key: a file that states no units, or strain without a thickness; fewer
/// than
///         two points; x that does not rise from 0, pressure that falls, is 0 at the first point beyond 0 or not 0
///         there; strain of 1 or more.
void read_pad(const SceneValues& values, PadScene& pad);

/// What is left of a pad's thickness at its curve's last point [m]; NaN without a thickness.
[[nodiscard]] double pad_left(const PadScene& pad);

/// Makes of a pad that was read the ground's stiffness and kinks, of which the last stands at the curve's end.  Slopes
/// that differ by less than 1e-12 of the larger are one piece.  Nothing without a curve.
void settle_pad(const PadScene& pad, const HalfSpaceScene& floor, numeric::Ground& ground);

/// "pad 0.02 m thick by foam.csv, 3 points up to 0.012 m and 50000 Pa (its last slope beyond),".
[[nodiscard]] std::string pad_words(const Scene& scene);

/// A question to whoever gave a pad that is thicker than the body is large, "mm typed?"; empty: none.
[[nodiscard]] std::string pad_doubts(const Scene& scene);

/// What to add of the pad to the warning that a body went so deep [m], beyond its curve; empty: the scene has none.
[[nodiscard]] std::string pad_remark(const Scene& scene, double depth);

/// Whether a body that goes so deep [m] leaves what a bed of springs describes of a pad: more than half its thickness.
[[nodiscard]] bool is_too_deep_for_springs(const Scene& scene, double depth);
/// A warning of that; empty: no pad of springs, or not so deep.
[[nodiscard]] std::string springs_warning(const Scene& scene, double depth);

}  // namespace clatter::validation
