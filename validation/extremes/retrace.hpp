// A discrete sequence held against the laws that it must obey, row by row in extended precision.
#pragma once

#include <string>

#include "analytic/sequence.hpp"

namespace clatter::validation {

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

/// e of the flat landing on a viscoelastic ground, s = c_G v/k_G >= 0: the root x = s e of
///     ln(1+s) − s = ln(1−x) + x
/// by bisection in extended precision.
[[nodiscard]] long double exact_restitution(long double damping_number);

}  // namespace clatter::validation
