// SPDX-License-Identifier: GPL-3.0-or-later
// Slip that turns: the curved part of an impact's path, by quadrature between two invariant directions.
//
// Slip turns from a repelling direction φ_r towards the next attracting one, φ_a.  With f, g, h of slip_field.hpp,
// ξ = |φ − φ_r|, w = |φ_a − φ_r|, m = (φ_r + φ_a)/2, κ = cos(w/2), D of slip_field.hpp (3) and
//     y = ln[sin(ξ/2)/sin((w − ξ)/2)],   dξ/dy = [cos(φ − m) − κ]/sin(w/2),                                  (1)
//     g = [cos(φ − m) − κ] E,   E = b₂ cos m − b₁ sin m + D [κ sin 2m + sin(φ + m)],                         (2)
//     d ln σ/dy = f dτ/dy,   dp/dy = σ dτ/dy,   dP_t/dy = −μ s dp/dy,   du/dy = h dp/dy,
//     dτ/dy = 1/(|E| sin(w/2)).                                                                              (3)
// E has neither pole nor zero between the two, so that (3) is smooth where slip stops (y → ∞) and near both directions;
// with ρ = e^y, cos φ and sin φ are rational, and each right-hand side is a function of y and of integrals before it:
// quadratures, no ODE.  So are the derivatives of (3) at a fixed distance from the start in y.
#pragma once

#include <array>

#include "analytic/space/impulse/path_progress.hpp"
#include "analytic/space/impulse/slip_field.hpp"

namespace clatter::analytic::space {

/// Two neighbouring invariant directions, and the angle of slip between them, not nearer to them than rounding.
struct SlipArc {
  Direction repelling;
  Direction attracting;
  double angle = 0;
};

/// How field, invariant directions and the angle of slip at the start change with the variables of PathDual.
struct SlipArcSlopes {
  const SlipFieldSlopes& field;
  SlipFieldSlopes::Row repelling, attracting;
  std::array<double, 5> angle;
};

/// Follows turning slip to the end of the law, or until its direction is the attracting one to rounding.  Returns
/// the direction of slip there.
/// @param slopes  if Number is PathDual
/// Accuracy: 1e-14 × (1 + changes of ln σ), times what rounding of φ at the start and of g where slip nearly stops
/// does; 1e-11 of their size for derivatives.
/// @throws NumericalError if 4000 panels do not resolve the path.
template <class Number>
Direction follow_turning_slip(const SlipField& field, const SlipArc& arc, const SlipArcSlopes* slopes,
                              PathProgress<Number>& progress);

}  // namespace clatter::analytic::space
