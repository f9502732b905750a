// SPDX-License-Identifier: GPL-3.0-or-later
// What may have gone wrong in a foreign run: hypotheses with one number each, fitted to the run's own impacts and
// flights, or to the rows as they were written.
#pragma once

#include <vector>

#include "validation/benchmark/cause.hpp"

namespace clatter::validation {

/// The one or two hypotheses that explain a run that fails; none where all leave more than a twentieth of the error.
///
/// Each impact is judged by the exact map at the run's own state before it (Score::law): restitution, friction,
/// inertia, lever and a restitution that is left out for slow contacts.  The flights tell gravity and damping; the
/// first touch angle, spin and speed; the pose at impacts a margin above the ground and a delay; the rows signs, axes,
/// units and frames; lists mass, ends and the sense of Omega.
[[nodiscard]] std::vector<Cause> causes_of(const Answer& answer, const Reference& reference, const Score& score);

}  // namespace clatter::validation
