// SPDX-License-Identifier: GPL-3.0-or-later
// How an impact came about, as equations with their numbers put in.
#pragma once

#include <string>
#include <vector>

#include "analytic/plane/sequence.hpp"
#include "validation/output/value.hpp"
#include "validation/reports/step_writer.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline reports {

/// The value with the digits that are known of it, of `digits`, and its unit.
[[nodiscard]] std::string value_text(const Equation& equation, int digits);

/// Steps that lead to impact n of a sequence (counted from 1), or to the reason why it does not happen.
[[nodiscard]] std::vector<Step> derive_impact(const Scene& scene, const analytic::Drop& drop,
                                              const analytic::Sequence& sequence, int n);

/// How impact n of a scene came about, in the plane or in space.
struct Explanation {
  Scene scene;
  int impact = 1;
  std::vector<Step> steps;
  std::vector<std::string> warnings;
  std::string shortfall;     ///< as of the sequence up to this impact
  int shortfall_status = 0;  ///< exit status that goes with it
};
[[nodiscard]] Explanation explain_impact(Scene scene, int n);
[[nodiscard]] Value explanation_fields(const Explanation& explanation);

}  // namespace clatter::validation::inline reports
