// SPDX-License-Identifier: GPL-3.0-or-later
// Exact map between the damping of a viscoelastic ground and the coefficient of restitution.
//
// For a contact force (k_G + c_G δ̇) K(δ) with any growth K and s = (c_G/k_G) v, v the approach speed,
//     ln[(1+s)/(1−s e)] = s (1+e),   so   e = [1 + W₀(−(1+s) e^{−(1+s)})]/s.
// Exact for one frictionless contact whose depth is set by one number (flat or upright landing).
#pragma once

namespace clatter::analytic {

/// e(s) for s = (c_G/k_G) v >= 0: 1 at s = 0, falls like 1 − 2s/3 and, for large s, like 1/s.
/// Accuracy: 4 ulp for all s, since 1 − e and 1 − s e are solved for without cancellation.
/// @throws std::domain_error unless s >= 0 (infinity gives 0).
[[nodiscard]] double restitution_of_damping(double damping_number);

/// 1 − e(s), with its relative accuracy for small s as well.  Accuracy: 8 ulp.
[[nodiscard]] double restitution_loss_of_damping(double damping_number);

/// de/ds; −2/3 at s = 0.  Accuracy: 1e-12 relative.
[[nodiscard]] double restitution_slope_of_damping(double damping_number);

/// The inverse s(e): 0 at e = 1, infinite at e = 0.  Accuracy: (4 + 2 × condition number) ulp.
/// @throws std::domain_error unless 0 <= e <= 1.
[[nodiscard]] double damping_of_restitution(double restitution);

}  // namespace clatter::analytic
