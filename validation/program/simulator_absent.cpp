// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for the simulator in the programs for a first table, which run no scene that begins at rest on the ground.
#include "numeric/equilibrium.hpp"
#include "validation/program/program.hpp"

namespace clatter::numeric {

Equilibrium equilibrium(const Body&, const World&, const MotionState&) { throw validation::LeftToNextProgram(); }
Equilibrium sliding_equilibrium(const Body&, const World&, const MotionState&) {
  throw validation::LeftToNextProgram();
}

}  // namespace clatter::numeric
