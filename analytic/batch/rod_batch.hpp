// SPDX-License-Identifier: GPL-3.0-or-later
// Contact angles of the thin rod for many θ at once.
#pragma once

#include <array>
#include <span>

#include "analytic/plane/contact_angles.hpp"

namespace clatter::analytic {

/// The first three impacts as ContactAngles has them; NaN for those that do not happen.
struct RodContacts {
  std::array<double, 2> angle{};                ///< β, γ [rad]
  std::array<double, 2> time{};                 ///< T₁, T₂ of the flights to them [L/|v_n|]
  std::array<double, 3> impulse{};              ///< P₁, P₂, P₃ [m|v_n|]
  std::array<double, 3> velocity{}, angular{};  ///< V, Ω after each [|v_n|], [|v_n|/L]
  int impacts = 1;
  bool is_scalar = false;  ///< by contact_angles()
};

/// contact_angles() for each θ [°], by the batch where that is certain of all impacts and of which end strikes: the
/// inclination after a flight is θ − Ω₁T₁ (β + Ω₂T₂ over the other end) with
///     Ω₁ = 6 P₁ (cos θ − μ_i sin θ),   Ω₂ = Ω₁ − 6 P₂ (cos β + μ_i sin β)   [|v_n|/L],
/// and must be the contact angle below the horizontal.  Ω₃ = Ω₂ + 6 P₃ (cos γ − μ_i sin γ), V_n = V_{n−1} − G T + P_n.
/// θ near 0° and 90°, near folds and e < 1e-4 are
/// contact_angles()'s. Accuracy: as contact_angles().
/// @throws as contact_angles(); std::invalid_argument unless both spans have one length.
void batch_contact_angles(std::span<const double> theta, const RodParameters& rod, std::span<RodContacts> rows);

}  // namespace clatter::analytic
