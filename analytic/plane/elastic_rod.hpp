// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic, frictionless impacts of a uniform thin rod as reflections, free of cancellation.
//
// In the plane of X = V_n and Y = kΩ kinetic energy is a circle, and an elastic frictionless impact of
// an end is the reflection that turns the state's angle χ into 2ψ + π − χ, where tan ψ = ∓√3 cos α for
// ends b and a.  For a rod that lies flat ψ = ±π/3, so χ stays a multiple of π/3 plus a small
// deviation.  Keeping these two apart keeps the digits of whatever nearly cancels: Ω after the third
// impact, 2 − ΣP, V + Ω/6.
#pragma once

#include "analytic/base/angle.hpp"

namespace clatter::analytic {

/// Where an end strikes: ψ = sense·(π/3 − tilt).
struct ReflectionAxis {
  int sense = 1;        ///< +1 for end a, −1 for end b (at |α| < 90°)
  double tilt = 0;      ///< δ >= 0 [rad], about (√3/4)·α²/2 for small α
  double cosine = 0.5;  ///< cos ψ
};

/// u = (1 − c)/(1 + 3c) = s²/[(1 + c)(1 + 3c)], so that tan(tilt) = √3 u.  Accuracy: 2 ulp.
[[nodiscard]] double tilt_tangent(double sine, double cosine);

/// Axis of an end at x = ±L/2 when the rod's inclination has this sine and cosine.
/// Accuracy: tilt 4 ulp, however small.
[[nodiscard]] ReflectionAxis reflection_axis(bool left_end, double sine, double cosine);

/// Velocity state (V, Ω) of a rod of length L: speed·(cos χ, sin χ) with χ = sextant·π/3 + deviation.
struct ElasticFrame {
  double speed = 0;      ///< √(V² + k²Ω²) [m/s]; 0: the frame carries nothing
  int sextant = 0;       ///< in 0..5
  double deviation = 0;  ///< [rad]

  [[nodiscard]] double normal() const;                ///< V [m/s]
  [[nodiscard]] double angular(double length) const;  ///< Ω = 2√3 speed sin χ/L [rad/s]
  /// Normal velocity of the end on the axis: V − Ω d_t.
  [[nodiscard]] double contact_velocity(const ReflectionAxis& axis) const;
  /// Elastic impact; returns the impulse per unit mass, −2 speed cos(χ − ψ) cos ψ.
  double reflect(const ReflectionAxis& axis);
};

// Small departures of the elastic rod's contact angles from the limit θ : β : γ = 2 : 1 : 2.

/// η = β − θ/2 and ε = γ − θ for e = 1, without friction and gravity.  Both are of the order θ³ and keep
/// their relative accuracy; β = θ/2 + η and γ = θ + ε are then good to an ulp for small θ.
/// With K₁ = −1/3 + k₁ and K₂ = 1/3 + k₂ (k of the order θ²) and d(x) = x − sin x the two contact
/// equations lose all terms of first order:
///     sin(θ/2 + η) − sin(θ/2) − K₁ η = (3/2) k₁ θ − d(θ) + d(θ/2),                               (1)
///     sin(θ + ε) − sin θ − K₂ ε = (3/2) k₂ θ + (1 + K₂) η + d(θ) − d(β).                          (2)
/// @param beta, gamma the roots as found by the flight, to start from.
[[nodiscard]] double first_offset(const Angle& theta, double beta);
[[nodiscard]] double second_offset(const Angle& theta, double eta, double gamma);

}  // namespace clatter::analytic
