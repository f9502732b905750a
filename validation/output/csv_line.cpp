// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/csv_line.hpp"

#include <algorithm>

#include "validation/output/number.hpp"

namespace clatter::validation {

namespace {

Cell read_cell(const CsvField& field) {
  const std::string text(field.text);
  double number = 0;
  if (field.quoted) return Cell(text);
  if (read_number(text, number)) {
    Cell cell(number, 6);
    if (is_short_whole(number)) cell.shown = text;
    return cell;
  }
  if (text == "true" || text == "false") return Cell(Value(text == "true"));
  return Cell(text_or_nothing(text));
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string shown_field(std::string_view field) {
  constexpr std::size_t longest = 40;
  std::string text(field.substr(0, longest));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.empty() ? "(empty)" : text + (field.size() > longest ? "..." : "");
}

char separator_of(std::string_view header) {
  const std::size_t at = header.find_first_of(",;\t");
  return at == std::string_view::npos ? ',' : header[at];
}

bool CsvLine::next(CsvField& field) {
  if (at_ > line_.size()) return false;
  const std::size_t start = std::min(line_.find_first_not_of(' ', at_), line_.size());
  if (start < line_.size() && line_[start] == '"') {
    read_quoted(start, field);
    return true;
  }
  const std::size_t end = std::min(line_.find(separator_, at_), line_.size());
  field = {at_ + 1, trimmed(line_.substr(at_, end - at_)), false, true};
  at_ = end + 1;
  return true;
}

void CsvLine::read_quoted(std::size_t start, CsvField& field) {
  unquoted_.clear();
  std::size_t i = start + 1;
  for (; i < line_.size(); ++i) {
    if (line_[i] == '"' && !(i + 1 < line_.size() && line_[i + 1] == '"')) break;
    if (line_[i] == '"') ++i;
    unquoted_ += line_[i];
  }
  const std::size_t end = std::min(line_.find(separator_, i), line_.size());
  const bool closed = i < line_.size() && trimmed(line_.substr(i + 1, end - i - 1)).empty();
  field = {start + 1, trimmed(unquoted_), true, closed};
  at_ = end + 1;
}

std::vector<Row> read_csv_rows(const std::string& text) {
  std::vector<Row> rows;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    if (line.starts_with("#")) continue;
    Row& row = rows.emplace_back();
    CsvLine fields(line, ',');
    for (CsvField field; fields.next(field);) row.push_back(read_cell(field));
  }
  return rows;
}

}  // namespace clatter::validation
