// SPDX-License-Identifier: GPL-3.0-or-later
// How well a foreign run flies between its impacts.
#pragma once

#include "validation/benchmark/score.hpp"

namespace clatter::validation::inline benchmark {

/// Energy that is gained or lost in flight, and the way that free flight does not explain, up to the last impact asked
/// for or Reference::until; of a problem of energy alone the energy at its end, too.  Adds to `score`.
void score_flights(const Motion& motion, const Reference& reference, const ReferenceSequence& sequence,
                   const std::vector<FoundImpact>& impacts, Score& score);

}  // namespace clatter::validation::inline benchmark
