// SPDX-License-Identifier: GPL-3.0-or-later
// Tables for web pages and notebooks.
#pragma once

#include <string>

#include "validation/output/report.hpp"

namespace clatter::validation {

/// With &, <, > and " as entities.
[[nodiscard]] std::string html_escaped(const std::string& text);

/// The shown columns as a `table` between paragraphs with head and notes; numbers to the right.
[[nodiscard]] std::string html_table(const Report& report);

}  // namespace clatter::validation
