// SPDX-License-Identifier: GPL-3.0-or-later
// JSON text.  Only sources that take JSON apart include <nlohmann/json.hpp>, which takes seconds to compile.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "validation/output/value.hpp"

namespace clatter::validation {

using Json = nlohmann::ordered_json;

/// Texts of any bytes, such as a file's name: those that are no UTF-8 become U+FFFD, since JSON has no other way to say
/// them.
///
/// Indented JSON with every number in its shortest round-trip form (nlohmann's own writer is not always
/// shortest) and short arrays of numbers on one line.
[[nodiscard]] std::string json_text(const Value& value);
/// The same without blanks, on one line.
[[nodiscard]] std::string compact_json(const Value& value);

}  // namespace clatter::validation
