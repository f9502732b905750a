// SPDX-License-Identifier: GPL-3.0-or-later
// Tables on a terminal: what was asked is dim, what cannot be predicted is bold.
#pragma once

#include <string>

namespace clatter::validation {

/// Whether stdout is a terminal that knows colours, and NO_COLOR is not set.
[[nodiscard]] bool shows_colours();

/// The text of a report as a table: dim as far as the heading of its first block, and each "?" that stands alone bold.
[[nodiscard]] std::string with_colours(const std::string& table);

}  // namespace clatter::validation
