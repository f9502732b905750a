#include "validation/output/json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

bool one_line(const Json& value) {
  if (!value.is_array()) return false;
  for (const Json& item : value) {
    if (item.is_structured()) return false;
  }
  return true;
}

void write(const Json& value, const std::string& indent, std::string& out);

void write_items(const Json& value, const std::string& indent, std::string& out) {
  const bool flat = one_line(value);
  const std::string inner = indent + "  ";
  const std::string separator = flat ? ", " : ",\n" + inner;
  out += value.is_array() ? "[" : "{";
  if (!flat) out += "\n" + inner;
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    if (!first) out += separator;
    first = false;
    if (value.is_object()) out += Json(key).dump() + ": ";
    write(item, inner, out);
  }
  if (!flat) out += "\n" + indent;
  out += value.is_array() ? "]" : "}";
}

void write(const Json& value, const std::string& indent, std::string& out) {
  if (value.is_structured() && !value.empty()) return write_items(value, indent, out);
  if (value.is_number_float()) {
    const double number = value.get<double>();
    out += std::isfinite(number) ? shortest(number) : "null";
    return;
  }
  out += value.dump();
}

}  // namespace

Json number_or_null(double value) { return std::isfinite(value) ? Json(value + 0.0) : Json(nullptr); }

Json text_json(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string json_text(const Json& value) {
  std::string out;
  write(value, "", out);
  return out + "\n";
}

}  // namespace clatter::validation
