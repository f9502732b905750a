// SPDX-License-Identifier: GPL-3.0-or-later
// What checks refer to: tables that the program carries (30 digits of the thin rod's first three impacts, and others),
// the contact angles of the elastic rod, of which many claims and errata speak, and the folds at which its second and
// third impact end.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analytic/plane/contact_angles.hpp"
#include "validation/oracles/reference_table.hpp"

namespace clatter::validation {

/// One row: column name → value rounded to double; columns with a gap are absent (this impact does not happen with a
/// contact angle up to 90°).
using ReferenceRow = std::map<std::string, double>;

/// The rows of validation/oracles/reference/NAME, if the program carries that.
[[nodiscard]] std::vector<oracle::ReferenceRow> reference_words(const std::string& name);

enum class ReferenceTable { no_gravity, gravity };

/// Columns theta_deg, G, beta_deg, gamma_deg, P1, P2, P3, V1, Omega1, V2, Omega2, V3, Omega3, T1, T2 for m = L = |v_n|
/// = 1.
[[nodiscard]] const std::vector<ReferenceRow>& reference_table(ReferenceTable table);

/// Contact angles of the elastic rod for θ in degrees; G = g L/v_n².
[[nodiscard]] inline analytic::ContactAngles elastic_angles(double degrees, double gravity_number = 0) {
  return contact_angles(analytic::Angle::from_degrees(degrees), {.gravity_number = gravity_number});
}

/// θ* at which the second impact ends, the other end grazing the ground: sin θ + K φ − sin(φ − θ) = 0 and cos(φ − θ) =
/// K with K = (1 − 3c²)/(6c), φ = θ + β (Eq. 12 and its derivative).  By bisection in long double.
[[nodiscard]] double second_impact_fold();
/// β* = arccos K there.
[[nodiscard]] double second_impact_fold_beta();
/// θ* at which the third impact ends [°], from an independent computation in 60 digits.
inline constexpr double third_impact_fold_deg = 27.577809606636;

}  // namespace clatter::validation
