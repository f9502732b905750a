// SPDX-License-Identifier: GPL-3.0-or-later
// Friction over a contact polygon whose points slip in different directions.
#pragma once

#include "numeric/contact/slip_edges.hpp"

namespace clatter::numeric {

/// The integrals, whatever the polygon's cut and the slopes of the slip.  With p₀ the point of no slip (v_r = 0):
/// - No slip to the north, as in the plane: a sum over the edges in closed form (one_way_slip_integrals).
/// - Slip that varies little over the polygon, against its own size: Gauss's rule on the triangles of a fan.
///   The direction is analytic up to the complex zeros of |v|² + v_r², whose distance gives the order.
/// - p₀ in or near the polygon, v_r = 0: each homogeneous part F_k, of degree k in p − p₀, of the integrand has
///   div((p − p₀) F_k) = (k + 2) F_k, so that
///       ∫F_k dA = 1/(k + 2) Σ h_e ∫F_k ds     over the edges e, h_e the signed distance of their line from p₀,   (1)
///   with elementary integrals along the edges: polynomials times 1/√quadratic.  Nothing is divided by the slopes'
///   determinant.
/// - The same with v_r > 0: the triangles between p₀ and the edges, in closed form along the rays from p₀, by Gauss's
///   rule along the edges (along_rays).
/// - Else (p₀ far, or none: slip with one steep direction): the closed form of (1) along the steep direction, and
///   across it Gauss's rule on parts that are halved until the complex singularities of the function across are far
///   from them.
/// Accuracy: 1e-13 of ∫|q| dA, or 10^−digits of the patch where that is more, times the polygon's size for the moments;
/// against extended precision over polygons, slivers among them, of any place and slopes of the slip.  No error is left
/// that would have to be estimated.
[[nodiscard]] SlipIntegrals slip_integrals(const SlipPatch& patch);

/// The same for estimates: right to some per cent, at a cost that does not depend on the slip.
[[nodiscard]] SlipIntegrals rough_slip_integrals(const SlipPatch& patch);

}  // namespace clatter::numeric
