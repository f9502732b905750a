// SPDX-License-Identifier: GPL-3.0-or-later
// Attitudes by number: the 26 drops of a box that drop-test standards have, on each face, edge and corner.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "numeric/base/linear_algebra.hpp"

namespace clatter::validation {

inline constexpr int orientation_count = 26;

/// Signs of the coordinates of the part that points down, 0 for an axis that it has no end of: 1 to 6 the faces −x, +x,
/// −y, +y, −z, +z; 7 to 18 the edges, 19 to 26 the corners, those with smaller signs first, x before y before z.
/// @param orientation  in 1..26
[[nodiscard]] std::array<int, 3> orientation_signs(int orientation);

/// The part that points down by those signs: "-x", "-x+z", "+x-y+z".
[[nodiscard]] std::string orientation_name(int orientation);

/// Euler parameters (body to world, scalar first) of a box of this size [m] whose face, edge or corner lies right below
/// the geometric centre, by the shortest turn from the box's own axes.
[[nodiscard]] std::vector<double> orientation_attitude(int orientation, const numeric::Vector3& size);

/// Whether four numbers are Euler parameters as people type them: of length 1 to within 0.01.
[[nodiscard]] bool is_attitude(std::span<const double> parameters);

}  // namespace clatter::validation
