// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of slip in one direction: the motion in a plane.
#pragma once

#include "numeric/contact/slip_integrals.hpp"

namespace clatter::numeric {

/// slip_integrals of a patch whose slip has no part to the north.  With ξ along the slope of the slip and η across, the
/// direction s depends on ξ alone, and the pressure q is a polynomial:
///     ∫q s dA = −∮ s(ξ) [∫q dη] dξ     over the edges,                                                  (1)
/// a polynomial times (ξ − ξ₀)/√((ξ − ξ₀)² + w²) along each, in closed form, or by Gauss's rule where that would
/// cancel.
[[nodiscard]] SlipIntegrals one_way_slip_integrals(const SlipPatch& patch);

}  // namespace clatter::numeric
