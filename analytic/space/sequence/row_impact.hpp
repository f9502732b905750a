// SPDX-License-Identifier: GPL-3.0-or-later
// The impact of a row of a sequence: of one corner, or of a group of corners or a level rim.
#pragma once

#include "analytic/space/impulse/strike_derivatives.hpp"
#include "analytic/space/sequence/impact_rows.hpp"

namespace clatter::analytic::space {

/// Fills in the impact of the row's corners from the state before: one corner, or a group of corners or a level rim.
/// @param derivatives  of the impact, if asked for; NaN for a group or a level rim
/// @throws as strike() and strike_together()
void strike_row(const Body& body, const ImpactLaw& law, ImpactRow& row, StrikeDerivatives* derivatives);

/// The impact of the same corners from a neighbouring state.  @throws as strike_row()
[[nodiscard]] Impact struck_again(const Body& body, const ImpactLaw& law, const ImpactRow& row, const State& before);

}  // namespace clatter::analytic::space
