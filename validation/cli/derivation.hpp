// How an impact came about, as equations with their numbers put in.
#pragma once

#include <string>
#include <vector>

#include "analytic/sequence.hpp"
#include "validation/output/value.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// One line of a derivation: `name = formula = numbers = value unit`.
struct Equation {
  std::string name;
  std::string formula;
  std::string numbers;  ///< the formula with numbers put in; may be empty
  double value = 0;
  std::string unit;
  double error = 0;  ///< bound on the value's error; infinite: not known
  double size = 0;   ///< of such values, against which one counts as zero
};

/// The value with the digits that are known of it, of `digits`, and its unit.
[[nodiscard]] std::string value_text(const Equation& equation, int digits);

/// A titled group of equations with a sentence before and after.
struct Step {
  std::string title;
  std::string text;
  std::vector<Equation> equations;
};

/// Steps that lead to impact n of a sequence (counted from 1), or to the reason why it does not happen.
[[nodiscard]] std::vector<Step> derive_impact(const Scene& scene, const analytic::Sequence& sequence, int n);

/// How impact n of a scene came about.
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

}  // namespace clatter::validation
