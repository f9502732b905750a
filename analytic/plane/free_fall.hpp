// SPDX-License-Identifier: GPL-3.0-or-later
// A body in the plane that is let go above the ground and flies freely, turning, to its first touch.
#pragma once

#include "analytic/plane/impact_rows.hpp"

namespace clatter::analytic {

/// The drop as it touches for the first time: inclination α₀ − Ω t, V_n − g t, with the first root of the vertices'
/// heights (first_root.hpp) and the errors that rounding of the numbers given leaves in it.
/// @param release  attitude, velocity and gravity as it is let go, on level ground
/// @param height  of the centre of mass then [m]
/// @throws std::domain_error if a vertex is not above the ground then, or none ever reaches it; NumericalError as
///         first_root()
[[nodiscard]] Drop after_free_fall(const Drop& release, double height);

}  // namespace clatter::analytic
