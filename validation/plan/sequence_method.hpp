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

/// A drop and its sequence, in the plane or in space: both the same.
struct DiscreteRun {
  DiscreteDrop drop;
  std::variant<analytic::Sequence, analytic::space::Sequence> sequence;

  [[nodiscard]] const std::vector<std::string>& warnings() const;
  /// The sequence if it is one in the plane.
  [[nodiscard]] const analytic::Sequence* planar() const { return std::get_if<analytic::Sequence>(&sequence); }
};

/// Runs the scene.  Warnings are left in the sequence.
/// @throws as discrete_drop and impact_sequence; BadInput if the closed form does not apply, with the reason.
[[nodiscard]] DiscreteRun run_discrete(const Scene& scene, SequenceMethod method);

}  // namespace clatter::validation::inline plan
