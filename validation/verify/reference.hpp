// SPDX-License-Identifier: GPL-3.0-or-later
// Reference tables that the program carries: 30 digits of the thin rod's first three impacts, and others.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/oracles/reference_table.hpp"

namespace clatter::validation::inline verify {

/// One row: column name → value rounded to double; columns with a gap are absent (this impact does not happen with a
/// contact angle up to 90°).
using ReferenceRow = std::map<std::string, double>;

/// The rows of tests/analytic/reference/NAME, if the program carries that.
[[nodiscard]] std::vector<oracle::ReferenceRow> reference_words(const std::string& name);

enum class ReferenceTable { no_gravity, gravity };

/// Columns theta_deg, G, beta_deg, gamma_deg, P1, P2, P3, V1, Omega1, V2, Omega2, V3, Omega3, T1, T2 for m = L = |v_n|
/// = 1.
[[nodiscard]] const std::vector<ReferenceRow>& reference_table(ReferenceTable table);

}  // namespace clatter::validation::inline verify
