// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace clatter::validation {

/// A word of a command as a shell takes it: in quotes where it needs them.
[[nodiscard]] std::string shell_word(const std::string& word);

}  // namespace clatter::validation
