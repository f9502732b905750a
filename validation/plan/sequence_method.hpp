// The discrete model by the name of its method.
#pragma once

#include <string>

#include "analytic/sequence.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

enum class SequenceMethod {
  automatic,    ///< the discrete model: the closed form costs as much, and knows less
  closed_form,  ///< Eqs. 9 and 12: thin elastic rod, at most three impacts
  discrete,
};

/// @throws BadInput naming the nearest of auto, closed-form and discrete.
[[nodiscard]] SequenceMethod read_sequence_method(const std::string& name);

/// Warnings are left in the sequence.  @throws BadInput if the closed form does not apply, with the reason.
[[nodiscard]] analytic::Sequence sequence_by_method(const Scene& scene, SequenceMethod method);

}  // namespace clatter::validation
