// SPDX-License-Identifier: GPL-3.0-or-later
// A derivation as LaTeX.
#pragma once

#include <string>
#include <vector>

#include "validation/reports/step_writer.hpp"

namespace clatter::validation::inline reports {

/// "NAME &= FORMULA", then the numbers put in and the value with its unit, each after `between`.
[[nodiscard]] std::string equation_tex(const Equation& equation, int digits, const std::string& between);
/// The words of an equation beside its formula, or in place of one.
[[nodiscard]] std::string equation_words(const Equation& equation);

/// The head as comments, then a paragraph of aligned equations for each step; words stand behind their equation.
[[nodiscard]] std::string explanation_latex(const std::vector<std::string>& head, const std::vector<Step>& steps,
                                            int digits);

}  // namespace clatter::validation::inline reports
