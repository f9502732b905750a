// SPDX-License-Identifier: GPL-3.0-or-later
// The discrete model in space, in the form that comparisons have.
#pragma once

#include "validation/compare/discrete_side.hpp"

namespace clatter::validation::inline compare {

/// @throws analytic::OutsideModelError where the first impact leaves the model.
[[nodiscard]] DiscreteSide space_side(const Scene& scene, const analytic::space::Drop& drop);

}  // namespace clatter::validation::inline compare
