// SPDX-License-Identifier: GPL-3.0-or-later
// The exact impact at a state that a foreign code had.
#pragma once

#include <vector>

#include "validation/benchmark/reference.hpp"

namespace clatter::validation::inline benchmark {

/// The state right after the points strike by `law`: the impact laws of the discrete model in space, or Moreau's.
/// A point that does not approach gets no impulse.
/// @throws as analytic::space::strike()
[[nodiscard]] analytic::space::State exact_map(const Reference& reference, const DeclaredLaw& law,
                                               const analytic::space::State& before, const std::vector<int>& points);

/// Moreau's impulse of one contact: Newton's restitution and Coulomb's cone for the velocity at the end,
///     v′ = v + W P,   v′_n = −e v_n,   |P_t| <= μ P_n,   P_t = −μ P_n v′_t/|v′_t| where v′_t ≠ 0.        (1)
/// Source: Moreau (1988), with e_t = 0.
/// @pre v_n < 0
/// @throws NumericalError if no direction of slip satisfies (1).
[[nodiscard]] analytic::space::Vector3 moreau_impulse(const analytic::space::Matrix3& inverse_inertia,
                                                      const analytic::space::Vector3& velocity,
                                                      const analytic::ImpactLaw& law);

}  // namespace clatter::validation::inline benchmark
