// A derivation as LaTeX.
#pragma once

#include <string>
#include <vector>

#include "validation/reports/step_writer.hpp"

namespace clatter::validation {

/// The head as comments, then a paragraph of aligned equations for each step; words stand behind their equation.
[[nodiscard]] std::string explanation_latex(const std::vector<std::string>& head, const std::vector<Step>& steps,
                                            int digits);

}  // namespace clatter::validation
