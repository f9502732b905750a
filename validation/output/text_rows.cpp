// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/text_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"

namespace clatter::validation {
namespace {

using Texts = std::vector<std::string>;

bool is_comment(std::string_view line) {
  return line.empty() || line.front() == '#' || line.front() == '%' || line.starts_with("//");
}

/// Without brackets about it.
std::string_view without_brackets(std::string_view text) {
  const bool is_bracketed = text.size() > 2 && (text.front() == '[' || text.front() == '(');
  return is_bracketed ? trimmed(text.substr(1, text.size() - 2)) : text;
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::optional<double> factor_of(std::span<const UnitName> units, std::string_view text) {
  const std::string name = lower(text);
  for (const UnitName& unit : units) {
    if (name == unit.name) return unit.factor;
  }
  return std::nullopt;
}

Texts TextRows::Layout::cut(std::string_view line, std::vector<std::size_t>* places) const {
  Texts texts;
  if (separator == ' ') {
    for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
      texts.emplace_back(line.substr(at, end - at));
      if (places) places->push_back(at + 1);
      at = line.find_first_not_of(" \t", end);
    }
    return texts;
  }
  CsvLine fields_of(line, separator);
  for (CsvField field; fields_of.next(field);) {
    texts.emplace_back(field.text);
    if (places) places->push_back(field.column);
  }
  if (texts.size() > 1 && texts.back().empty()) texts.pop_back();  // a separator at the end of a line
  return texts;
}

bool TextRows::Layout::read(std::string text, double& value) const {
  if (decimal_comma) std::replace(text.begin(), text.end(), ',', '.');
  return read_number(text, value);
}

/// How many of the fields are numbers.
std::size_t TextRows::Layout::numbers(const Texts& texts) const {
  double value = 0;
  return static_cast<std::size_t>(
      std::count_if(texts.begin(), texts.end(), [&](const auto& text) { return read(text, value); }));
}

TextRows::TextRows(const std::string& path, std::span<const std::span<const UnitName>> units, const std::string& needed)
    : path_(path), text_(NumericTable::text_of(path)), units_(units) {
  for (const std::string_view line : lines_of(without_byte_order_mark(text_)))
    lines_.push_back({lines_.size() + 1, trimmed(line)});
  find_rows(needed);
  read_head();
  read_rows();
}

void TextRows::refuse(const std::string& words) const { throw BadInput(path_ + ": " + words); }

void TextRows::refuse(std::size_t row, const std::string& words) const {
  throw BadInput("{}:{}:1: {}", path_, row_lines_[row], words);
}

/// The layout in which this line is a row of numbers, or of texts among numbers, and so is the next one that is no
/// comment.
std::optional<TextRows::Layout> TextRows::layout_at(std::size_t line, bool with_texts) const {
  std::size_t next = line + 1;
  while (next < lines_.size() && is_comment(lines_[next].text)) ++next;
  if (next == lines_.size()) return std::nullopt;
  for (const char separator : {';', '\t', ',', ' '}) {
    for (const bool decimal_comma : {false, true}) {
      if (decimal_comma && separator == ',') continue;
      Layout layout{separator, decimal_comma};
      const Texts first = layout.cut(lines_[line].text), second = layout.cut(lines_[next].text);
      // A lone field with a comma may as well be two fields.
      if (first.size() != second.size() || (decimal_comma && first.size() < 2)) continue;
      const std::size_t least = with_texts ? std::min<std::size_t>(first.size(), 2) : first.size();
      if (first.empty() || layout.numbers(first) < least || layout.numbers(second) < least) continue;
      layout.fields = first.size();
      return layout;
    }
  }
  return std::nullopt;
}

void TextRows::find_rows(const std::string& needed) {
  for (const bool with_texts : {false, true}) {
    for (first_ = 0; first_ < lines_.size(); ++first_) {
      if (is_comment(lines_[first_].text)) continue;
      if (const auto layout = layout_at(first_, with_texts)) {
        layout_ = *layout;
        return;
      }
    }
  }
  refuse("no rows of numbers: " + needed);
}

bool TextRows::is_unit(std::string_view text) const {
  return std::any_of(units_.begin(), units_.end(),
                     [&](std::span<const UnitName> of) { return factor_of(of, text).has_value(); });
}

/// "Acceleration x (m/s^2)" or "ax [g]" or "acc_g" cut into name and unit.
TextRows::Column TextRows::name_and_unit(std::string_view text) const {
  text = trimmed(text);
  for (const auto& [open, close] : {std::pair{'(', ')'}, {'[', ']'}}) {
    const std::size_t begin = text.rfind(open), end = text.rfind(close);
    if (begin != std::string_view::npos && end != std::string_view::npos && end > begin)
      return {std::string(trimmed(text.substr(0, begin))),
              std::string(trimmed(text.substr(begin + 1, end - begin - 1)))};
  }
  for (const char mark : {'_', ' ', '/'}) {
    const std::size_t at = text.find(mark);
    if (at == std::string_view::npos || at == 0) continue;
    const std::string_view unit = trimmed(text.substr(at + 1));
    if (is_unit(unit)) return {std::string(trimmed(text.substr(0, at))), std::string(unit)};
  }
  // "Stress in kPa", "kPa of stress".
  const std::size_t last = text.rfind(' '), first = text.find(' ');
  if (first == std::string_view::npos) return {std::string(text), ""};
  if (is_unit(text.substr(last + 1))) return {std::string(text.substr(0, first)), std::string(text.substr(last + 1))};
  if (is_unit(text.substr(0, first))) return {std::string(text.substr(last + 1)), std::string(text.substr(0, first))};
  return {std::string(trimmed(text)), ""};
}

bool TextRows::names_units(const Texts& names) const {
  return layout_.numbers(names) == 0 && std::ranges::any_of(names, [&](const std::string& name) {
           const std::string unit = name_and_unit(name).unit;
           return is_unit(unit.empty() ? without_brackets(trimmed(name)) : unit);
         });
}

/// The line above the first rows of numbers is one of them with a bad field, no names of columns, where it begins with
/// a number, or has one and names with units above it.
void TextRows::refuse_row_of_head(std::size_t line, const Texts& fields, bool is_named) const {
  double value = 0;
  if (!layout_.read(fields[0], value) && !(is_named && layout_.numbers(fields) > 0)) return;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (!layout_.read(fields[k], value)) refuse_number(line, k, fmt::format("{}", k + 1));
  }
}

void TextRows::read_head() {
  std::vector<Texts> named;  // lines with as many fields, the nearest one first
  std::vector<std::size_t> lines;
  for (std::size_t i = first_; i-- > 0;) {
    std::string_view text = lines_[i].text;
    above_.emplace_back(text);
    const std::size_t marks = std::min(text.find_first_not_of("#%/ "), text.size());
    if (marks == text.size() || text[marks] != layout_.separator) text = trimmed(text.substr(marks));  // else per cent
    if (text.empty()) continue;
    Texts fields = layout_.cut(text);
    if (fields.size() == layout_.fields && named.size() < 2) {
      lines.push_back(i);
      named.push_back(std::move(fields));
    } else if (named.empty()) {
      break;
    }
  }
  if (!named.empty()) refuse_row_of_head(lines[0], named[0], named.size() == 2 && names_units(named[1]));
  const auto is_unit_or_none = [&](std::string_view text) {
    text = without_brackets(text);
    return text.empty() || text == "-" || is_unit(text);
  };
  const bool has_units = named.size() == 2 && std::all_of(named[0].begin(), named[0].end(), is_unit_or_none);
  for (std::size_t i = 0; i < layout_.fields; ++i) {
    Column column{fmt::format("{}", i + 1), ""};
    if (!named.empty()) column = name_and_unit(named[has_units ? 1 : 0][i]);
    if (has_units) column.unit = without_brackets(named[0][i]);
    columns_.push_back(column);
  }
}

void TextRows::read_rows() {
  for (std::size_t i = first_; i < lines_.size(); ++i) {
    if (is_comment(lines_[i].text)) continue;
    const Texts texts = layout_.cut(lines_[i].text);
    row_lines_.push_back(lines_[i].number);
    if (texts.size() != layout_.fields)
      refuse(count() - 1, fmt::format("{} fields: must be {} as in the rows above", texts.size(), layout_.fields));
    for (const std::string& text : texts) {
      double value = 0;
      numbers_.push_back(layout_.read(text, value) ? value : std::nan(""));
    }
  }
}

std::string TextRows::names() const {
  Texts all;
  for (const Column& column : columns_) all.push_back(column.name);
  return fmt::format("{}", fmt::join(all, ", "));
}

double TextRows::number(std::size_t row, std::size_t column) const {
  const double value = at(row, column);
  if (std::isfinite(value)) return value;
  refuse_number(row_lines_[row] - 1, column, columns_[column].name);
}

void TextRows::refuse_number(std::size_t line, std::size_t column, const std::string& name) const {
  std::vector<std::size_t> places;
  const std::string text = layout_.cut(lines_[line].text, &places)[column];
  throw BadInput("{}:{}:{}: column {} = {}: must be a finite number", path_, lines_[line].number, places[column], name,
                 shown_field(text));
}

}  // namespace clatter::validation
