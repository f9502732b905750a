// SPDX-License-Identifier: GPL-3.0-or-later
// A discrete sequence held against the laws that it must obey, row by row in extended precision.
#pragma once

#include <string>

#include "analytic/plane/sequence.hpp"

namespace clatter::validation::inline extremes {

inline constexpr const char* retrace_oracle = "laws of motion, row by row at 64 bits";

struct Retrace {
  /// Largest residual of a law, relative to the sum of the magnitudes of its terms: parabola and turn of each flight,
  /// arriving vertices at height 0 and none below, both momentum balances, restitution, Coulomb's bound, energy.
  double residual = 0;
  /// Largest height of an arriving vertex, relative to the body's reach.
  double placement = 0;
  /// Largest |energy − (first energy − losses so far)| over the first energy.
  double energy_drift = 0;
  /// |Σ P − m (V − V₀ + g t)| over Σ P, up to the last row.
  double momentum_drift = 0;
  std::string worst;  ///< the law with the largest residual, and the row
};

/// Numbers that are not finite give residuals that are infinite.
[[nodiscard]] Retrace retrace(const analytic::Drop& drop, const analytic::Sequence& sequence);

}  // namespace clatter::validation::inline extremes
