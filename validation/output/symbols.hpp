// SPDX-License-Identifier: GPL-3.0-or-later
// Characters in other notations.
#pragma once

#include <string>
#include <string_view>

namespace clatter::validation {

/// LaTeX for the characters that it reads as commands, and for the symbols that the program prints.
[[nodiscard]] std::string to_latex(const std::string& text);
/// Plain ASCII for the mathematical and Greek characters that the program prints.
[[nodiscard]] std::string to_ascii(const std::string& text);

enum class Lines { escaped, kept };
/// Foreign text as a terminal may have it: control characters, which could move its cursor or take it over, and bytes
/// that are no UTF-8 become escapes such as \x1b.  Line feeds stay where lines are kept.
[[nodiscard]] std::string printable(std::string_view text, Lines lines = Lines::escaped);

}  // namespace clatter::validation
