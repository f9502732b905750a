// SPDX-License-Identifier: GPL-3.0-or-later
// What facets leave of a round body.
#pragma once

#include <string>

#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// Adds to the error estimates of a run what facets may add where the mesh of a rod has the sectors that the program
/// chooses, said or not: in an impact that goes D deep s/D of its time, force, depth, energies and changes of velocity,
/// all of them where D < s (facet_words()).  What impacts before have left grows with the row's amplification, and is
/// not known without.  A mesh of other sectors that the scene gives, and that of a rod no thicker than a thin one is
/// taken for, the paper's, count as the body. The turn about its axis that a facet gives a level rod is not in s/D.
void add_facet_errors(const Scene& scene, numeric::Simulation& run);

/// How far the impacts of a meshed body may be off those of the round one; empty: no facets stand for a round one.
/// The mesh holds a round body whose surface lies s inside the true one, and is held by the true one.
/// Where a blow goes in D, so is its depth off by s at most; a shift of the depth changes neither the force nor what
/// comes after, and their error is of higher order in s/D.  Measured on rods and coins of 16 and 64 sectors, 0.5° to
/// 80°, tilted or not, with friction and damping, s/D from 0.001 to 0.15: depth 0.82 s, duration 0.53 s/D, peak force
/// 0.5 s/D, change of velocity 0.12 s/D.  So s/D bounds each of these of one impact, given how it begins.
[[nodiscard]] std::string facet_words(const Scene& scene, const numeric::Simulation& run);

}  // namespace clatter::validation
