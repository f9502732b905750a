// SPDX-License-Identifier: GPL-3.0-or-later
// Collocation at Radau points: an implicit Runge–Kutta method for motions that are stiff at first.
//
// The rates K_j at the points c_j of a step h from y give
//     Y_i = y + h Σ_j A_ij K_j,   A_ij = ∫₀^{c_i} l_j(c) dc,   c_s = 1,                                     (1)
// l_j the polynomials of Lagrange.  The error of Y_s is of order h^(2s) where the motion is not stiff; one that is
// driven back to where its slow solution lies is damped whatever the step (Hairer and Wanner, Radau IIA).
#pragma once

#include <Eigen/Core>

namespace clatter::analytic::space {

struct RadauRule {
  static constexpr int points = 6;
  using Array = Eigen::Matrix<double, points, 1>;

  RadauRule();

  Array at;                                      ///< c_j, ascending, the last is 1
  Eigen::Matrix<double, points, points> weight;  ///< A
  /// Coefficient of the highest Legendre polynomial of what has these values at the points: it falls off geometrically
  /// with the number of points, and times h bounds what the polynomial through them leaves out of Y_s.
  Array highest;
};

}  // namespace clatter::analytic::space
