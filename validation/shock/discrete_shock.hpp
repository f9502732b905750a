// SPDX-License-Identifier: GPL-3.0-or-later
// What each impact of the discrete model does to points of the body.
#pragma once

#include <vector>

#include "validation/run/discrete_run.hpp"
#include "validation/shock/shock_rows.hpp"

namespace clatter::validation {

/// The changes of velocity, with errors from those of the impulse P and the attitude φ at each impact:
///     ΔV = ΔV_c + Δω × r,   |δΔV| <= |δP|/m + |r| |δΔω| + |Δω × r| |δφ|,
///     |δΔω| <= K |δP| + 2 |Δω| |δφ|,   K the largest |I⁻¹ (r_c × p)| of unit impulses p at what strikes.
/// A sequence's infinitely many impacts after its last row are left out.
/// @param places  of the probes, from the centre of mass, body frame [m]
[[nodiscard]] std::vector<ShockRow> discrete_shock(const DiscreteDrop& drop, const DiscreteSequence& sequence,
                                                   const std::vector<Vector3>& places);

}  // namespace clatter::validation
