// SPDX-License-Identifier: GPL-3.0-or-later
// How far the two models must differ in space on a ground of finite stiffness: prediction.hpp for any motion.
#pragma once

#include "analytic/space/sequence.hpp"
#include "validation/compare/prediction.hpp"

namespace clatter::validation::inline compare {

/// As predicted_sizes in the plane: gravity for T, a turn by |Ω| T/2 about the axis of Ω before or after, whichever is
/// faster, the corner v T/(2π) further inside along each of the body's axes, half the duration of each contact before.
/// The body has no rims.
[[nodiscard]] std::vector<PredictedSize> predicted_sizes(const analytic::space::Drop& drop,
                                                         const analytic::space::Sequence& sequence,
                                                         const std::vector<double>& contact_times);

/// The drop that begins with this row: the state before it.
[[nodiscard]] analytic::space::Drop drop_at(const analytic::space::Drop& drop, const analytic::space::ImpactRow& row);

}  // namespace clatter::validation::inline compare
