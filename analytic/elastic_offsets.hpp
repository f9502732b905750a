// SPDX-License-Identifier: GPL-3.0-or-later
// Small departures of the elastic rod's contact angles from the limit θ : β : γ = 2 : 1 : 2.
#pragma once

#include "analytic/angle.hpp"

namespace clatter::analytic {

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
