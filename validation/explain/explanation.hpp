// SPDX-License-Identifier: GPL-3.0-or-later
// How an impact came about: from a scene, its drop and the impact's number to steps of formulas with their numbers.
#pragma once

#include <string>
#include <vector>

#include "validation/explain/formula.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// How impact n of a scene came about, in the plane or in space.
struct Explanation {
  Scene scene;
  int impact = 1;
  double approach_speed = 0;  ///< of the first contact [m/s]
  std::vector<Step> steps;
  std::vector<std::string> warnings;
  std::string shortfall;     ///< as of the sequence up to this impact
  int shortfall_status = 0;  ///< exit status that goes with it
};

/// Steps that lead to impact n of the drop (n >= 1), or to the reason why it does not happen.  The numbers are those of
/// its sequence.
/// @throws as analytic::impact_sequence and analytic::space::impact_sequence
[[nodiscard]] Explanation explain_impact(const PreparedScene& prepared, int n);

}  // namespace clatter::validation
