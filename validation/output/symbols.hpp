// SPDX-License-Identifier: GPL-3.0-or-later
// The program's characters in other notations.
#pragma once

#include <string>

namespace clatter::validation::inline output {

/// LaTeX for the characters that it reads as commands, and for the symbols that the program prints.
[[nodiscard]] std::string to_latex(const std::string& text);
/// Plain ASCII for the mathematical and Greek characters that the program prints.
[[nodiscard]] std::string to_ascii(const std::string& text);

}  // namespace clatter::validation::inline output
