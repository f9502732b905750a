// SPDX-License-Identifier: GPL-3.0-or-later
// JSON text.  Only sources that take JSON apart include <nlohmann/json.hpp>, which takes seconds to compile.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

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

/// Takes the pieces of a text, in order.
using WriteText = std::function<void(std::string_view)>;

/// The text of json_text() of fields whose list of that name, there empty, has so many items.
/// @throws std::invalid_argument if the fields have no such list
void write_json(const Value& fields, const std::string& list, std::size_t count,
                const std::function<Value(std::size_t)>& item, const WriteText& write);

}  // namespace clatter::validation
