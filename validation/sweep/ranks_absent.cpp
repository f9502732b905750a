// SPDX-License-Identifier: GPL-3.0-or-later
// A build without MPI: always one process.
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation::inline sweep {

Ranks::Ranks() = default;
Ranks::~Ranks() = default;
void Ranks::hand_out(RangeQueue&, const SweepHooks&) {}
void Ranks::serve(const ComputeRange&) {}

}  // namespace clatter::validation::inline sweep
