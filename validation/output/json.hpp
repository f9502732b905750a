// JSON text.  Sources that make or take values include <nlohmann/json.hpp>, which takes a second to compile,
// themselves.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace clatter::validation {

using Json = nlohmann::ordered_json;

/// A number, or null where it is not finite.
[[nodiscard]] Json number_or_null(double value);

/// A text of any bytes, such as a file's name; those that are no UTF-8 become U+FFFD, since JSON has no other way to
/// say them.
[[nodiscard]] Json text_json(const std::string& text);

/// Indented JSON with every number in its shortest round-trip form (nlohmann's own writer is not always
/// shortest) and short arrays of numbers on one line.
[[nodiscard]] std::string json_text(const Json& value);

}  // namespace clatter::validation
