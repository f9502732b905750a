// SPDX-License-Identifier: GPL-3.0-or-later
// Height of a vertex during free flight.
//
// While the centre of mass moves on its parabola and the body turns at the constant rate Ω = σω,
// the height of a vertex is
//     h(t) = h₀ + v₀ t − g t²/2 + p (1 − cos ωt) + q (ωt − sin ωt),                        (1)
// h₀, v₀ its height and normal velocity at t = 0 and p = −d_n, q = σ d_t its offset there.  Written
// so, no term cancels for small angles.  h = 0 for the other end of the unit rod is Eq. 12 of Shan
// et al. (2005); the gravity term printed there has another sign and half the size.
#pragma once

#include "analytic/detail/small_angle.hpp"

namespace clatter::analytic {

/// Coefficients of (1).
struct VertexHeight {
  double height = 0;    ///< h₀ >= 0 [m]
  double velocity = 0;  ///< v₀ [m/s]
  double gravity = 0;   ///< g [m/s²]; negative values (upwards) only for the paper's printed term
  double rate = 0;      ///< ω >= 0 [rad/s]
  double versine = 0;   ///< p [m]
  double sine = 0;      ///< q [m]

  struct Value {
    double height = 0;    ///< h(t)
    double velocity = 0;  ///< h′(t)
    /// Sum of the magnitudes of the terms of h(t): the rounding error of h is below 4ε × this.
    double scale = 0;
  };
  /// h and h′ of (1).  Accuracy: 4 ε × scale.
  [[nodiscard]] Value at(double t) const { return at(t, detail::Turn(rate * t)); }
  /// The same with the angle turned, rate × t, which all vertices share.
  [[nodiscard]] Value at(double t, const detail::Turn& turn) const;
  /// h″(t).
  [[nodiscard]] double acceleration(double t) const;
  /// Sum of the magnitudes of the terms of h′(t), with the error of the angle turned: h′ is known
  /// to 4ε × this.
  [[nodiscard]] double velocity_scale(double t) const;
};

}  // namespace clatter::analytic
