// SPDX-License-Identifier: GPL-3.0-or-later
// A row of the sequence: what strikes there, and how the corners leave.
#pragma once

#include <vector>

#include "analytic/space/first_contact.hpp"
#include "analytic/space/sequence.hpp"

namespace clatter::analytic::space {

/// Fills in the impact of the row's corners from the state before: one corner, or a group of corners or a level rim.
/// @throws as strike() and strike_together()
void strike_row(const Body& body, const Law& law, ImpactRow& row);

/// The impact of the same corners from a neighbouring state, by which the row's errors are carried on.
[[nodiscard]] Impact struck_again(const Body& body, const Law& law, const ImpactRow& row, const State& before);

/// Sets `touches` to the row's corners with their normal velocities in the state after the impact; what is rounding of
/// zero is zero.
void find_departures(const Law& law, const ImpactRow& row, const State& after, std::vector<Touch>& touches);

}  // namespace clatter::analytic::space
