// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the source tree that the program carries in itself, so that it needs none beside it.
#pragma once

#include <string_view>
#include <vector>

namespace clatter::validation {

struct EmbeddedFile {
  std::string_view name;  ///< path in the source tree
  std::string_view text;
};

/// Scene files, the checks and the 30-digit reference tables.
[[nodiscard]] const std::vector<EmbeddedFile>& embedded_files();
/// @throws std::out_of_range if there is no such file.
[[nodiscard]] std::string_view embedded_text(std::string_view name);

}  // namespace clatter::validation
