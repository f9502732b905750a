// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the discrete model by the name of its method.
#pragma once

#include <string>

#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation::inline plan {

enum class SequenceMethod {
  automatic,    ///< the discrete model: the closed form costs as much, and knows less
  closed_form,  ///< Eqs. 9 and 12: thin elastic rod, at most three impacts
  discrete,
};

/// @throws BadInput naming the nearest of auto, closed-form and discrete.
[[nodiscard]] SequenceMethod read_sequence_method(const std::string& name);

/// A sequence of the discrete model, and its record.
struct DiscreteRun {
  DiscreteSequence sequence;
  Run run;
};

/// Runs the scene.  Warnings are left in the run.
/// @throws as impact_sequence; BadInput if the closed form does not apply, with the reason.
[[nodiscard]] DiscreteRun run_discrete(const PreparedScene& prepared, SequenceMethod method);

}  // namespace clatter::validation::inline plan
