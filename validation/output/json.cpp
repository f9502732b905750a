// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace clatter::validation {
namespace {

using List = Value::List;
using Fields = Value::Fields;

/// As JSON writes it, DEL and C1, which JSON lets pass, as escapes like other control characters; bytes that are no
/// UTF-8 become U+FFFD.
std::string quoted(const std::string& text) {
  const bool is_plain =
      std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < '\x7F' && c != '"' && c != '\\'; });
  if (is_plain) return '"' + text + '"';
  const std::string dumped = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  for (std::size_t i = 0; i < dumped.size(); ++i) {
    const auto byte = static_cast<unsigned char>(dumped[i]);
    const bool is_c1 = byte == 0xC2 && static_cast<unsigned char>(dumped[i + 1]) < 0xA0;
    if (byte == 0x7F) out += "\\u007f";
    else if (is_c1) out += fmt::format("\\u{:04x}", static_cast<unsigned char>(dumped[++i]));
    else out += dumped[i];
  }
  return out;
}

bool is_structured(const Value& value) {
  return std::holds_alternative<List>(value.content()) || std::holds_alternative<Fields>(value.content());
}

/// Writes values; `indented` over several lines.
class Writer {
 public:
  /// @param depth  of what is open already
  explicit Writer(bool indented, std::size_t depth = 0) : indented_(indented), depth_(depth) {}

  void write(const Value& value) {
    if (const auto* list = std::get_if<List>(&value.content())) return write_list(*list);
    if (const auto* fields = std::get_if<Fields>(&value.content())) return write_fields(*fields);
    if (const auto* text = std::get_if<std::string>(&value.content())) out_ += quoted(*text);
    else out_ += value.is_nothing() ? "null" : value.text();
  }
  [[nodiscard]] const std::string& text() const { return out_; }
  void begin_line() { out_.append(1, '\n').append(2 * depth_, ' '); }

 private:
  void write_list(const List& list) {
    const bool lines = indented_ && std::ranges::any_of(list, is_structured);
    write_all("[]", list, lines, lines || !indented_ ? "," : ", ", [&](const Value& item) { write(item); });
  }

  void write_fields(const Fields& fields) {
    write_all("{}", fields, indented_, ",", [&](const Field& field) {
      out_ += quoted(field.name) + (indented_ ? ": " : ":");
      write(field.value);
    });
  }

  /// Items between brackets, on lines of their own or not.
  void write_all(const char* brackets, const auto& items, bool lines, const char* between, const auto& write_item) {
    out_ += brackets[0];
    ++depth_;
    for (const auto& item : items) {
      if (&item != &items.front()) out_ += between;
      if (lines) begin_line();
      write_item(item);
    }
    --depth_;
    if (lines && !items.empty()) begin_line();
    out_ += brackets[1];
  }

  bool indented_;
  std::size_t depth_;  // of what is open
  std::string out_;
};

}  // namespace

std::string json_text(const Value& value) {
  Writer writer(true);
  writer.write(value);
  return writer.text() + "\n";
}

std::string compact_json(const Value& value) {
  Writer writer(false);
  writer.write(value);
  return writer.text();
}

void write_json(const Value& fields, const std::string& list, std::size_t count,
                const std::function<Value(std::size_t)>& item, const WriteText& write) {
  const Value* const place = fields.find(list);
  if (place == nullptr || !std::holds_alternative<List>(place->content()))
    throw std::invalid_argument("write_json: no list " + list);
  const std::string whole = json_text(fields), opened = "\n  " + quoted(list) + ": [";
  const std::size_t cut = whole.find(opened) + opened.size();  // a line of that depth begins nothing but a field
  write(std::string_view(whole).substr(0, cut));
  for (std::size_t i = 0; i < count; ++i) {
    Writer writer(true, 2);
    writer.begin_line();
    writer.write(item(i));
    write((i > 0 ? "," : "") + writer.text());
  }
  write((count > 0 ? "\n  " : "") + whole.substr(cut));
}

}  // namespace clatter::validation
