// SPDX-License-Identifier: GPL-3.0-or-later
// Friction with a rounded direction of slip, along rays from the point of no slip.
#pragma once

#include "numeric/contact/slip_segment.hpp"

namespace clatter::numeric {

/// Friction of the triangle between the point of no slip p₀ and a segment, over half of twice its area: with p on the
/// segment, v the slip there, W = |v| and λ from p₀ to p,
///     ∫dσ ∫_0^1 λ q(p₀ + λ(p − p₀)) λ v/√(λ² W² + v_r²) dλ,   v_r > 0,                                  (1)
/// and the same times the place from p₀ on.  q is a polynomial in λ: along the ray closed forms of
/// ∫λⁿ/√(λ² W² + v_r²) dλ; along the segment Gauss's rule, on parts that are halved until the complex zeros of W² +
/// v_r², the only singularities, are far from them.  `segment`'s middle and slip are those from p₀ on; its parts do not
/// count.
[[nodiscard]] SlipIntegrals along_rays(const SlipPatch& patch, const SlipSegment& segment);

}  // namespace clatter::numeric
