// SPDX-License-Identifier: GPL-3.0-or-later
// Slip that turns: the curved part of an impact's path, by quadrature between two invariant directions.
//
// Slip turns from a repelling direction φ_r towards the next attracting one, φ_a.  With f, g, h of slip_field.hpp and
//     y = ln[(φ − φ_r)/(φ_a − φ)],   dφ/dy = (φ − φ_r)(φ_a − φ)/(φ_a − φ_r),   dτ/dy = (dφ/dy)/g:        (1)
//     d ln σ/dy = f dτ/dy,   dp/dy = σ dτ/dy,   dP_t/dy = −μ s dp/dy,   du/dy = h dp/dy.                    (2)
// g/[(φ − φ_r)(φ_a − φ)] has neither pole nor zero between the two, so that (2) is smooth where slip stops (y → ∞) and
// near both directions; each right-hand side is a function of y and of integrals before it: quadratures, no ODE.
#pragma once

#include "analytic/space/path_progress.hpp"
#include "analytic/space/slip_field.hpp"

namespace clatter::analytic::space {

/// Two neighbouring invariant directions, and the angle of slip between them, not nearer to them than rounding.
struct SlipArc {
  Direction repelling;
  Direction attracting;
  double angle = 0;
};

/// Follows turning slip to the end of the law, or until its direction is the attracting one to rounding.  Returns
/// the direction of slip there.
/// Accuracy: 1e-14 × (1 + changes of ln σ), times what rounding of φ at the start and of g where slip nearly stops
/// does.
/// @throws NumericalError if 4000 panels do not resolve the path.
Direction follow_turning_slip(const SlipField& field, const SlipArc& arc, PathProgress& progress);

}  // namespace clatter::analytic::space
