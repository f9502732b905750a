// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the discrete model with its record.
#pragma once

#include <string>

#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {

/// The method of the discrete model under its name, "auto" or "discrete", which are the same.
/// @throws BadInput for closed-form, which former versions had, and for unknown names.
std::string read_sequence_method(const std::string& option, const std::string& name);

/// A sequence of the discrete model, and its record.
struct DiscreteRun {
  DiscreteSequence sequence;
  Run run;
};

/// Runs the scene.  Warnings are left in the run.
/// @throws as impact_sequence.
[[nodiscard]] DiscreteRun run_discrete(const PreparedScene& prepared);

}  // namespace clatter::validation
