// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace clatter::validation::inline output {

/// A word of a command as a shell takes it: in quotes where it needs them.
[[nodiscard]] std::string shell_word(const std::string& word);

/// A command as lines that a shell reads as one: each but the last ends in a backslash, and none has more than `width`
/// columns unless a word, quoted or not, is as long.  Lines after the first begin with `indent`.
[[nodiscard]] std::string folded_command(const std::string& command, const std::string& indent = "  ",
                                         std::size_t width = 79);

}  // namespace clatter::validation::inline output
