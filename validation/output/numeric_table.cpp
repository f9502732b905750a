// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/numeric_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation {
namespace {

/// The separator of a header: the first of , ; tab in it, or a comma.
char separator_of(std::string_view header) {
  const std::size_t at = header.find_first_of(",;\t");
  return at == std::string_view::npos ? ',' : header[at];
}

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

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin < text.size(); begin += lines.back().size() + 1)
    lines.push_back(text.substr(begin, text.find('\n', begin) - begin));
  return lines;
}

std::string shown_field(std::string_view field) {
  constexpr std::size_t longest = 40;
  std::string text(field.substr(0, longest));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.empty() ? "(empty)" : text + (field.size() > longest ? "..." : "");
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
  for (const std::string_view line : lines_of(text)) {
    if (line.starts_with("#")) continue;
    Row& row = rows.emplace_back();
    CsvLine fields(line, ',');
    for (CsvField field; fields.next(field);) row.push_back(read_cell(field));
  }
  return rows;
}

namespace {

/// A number too small for a double is 0.
bool read_field(std::string_view text, double& value) {
  if (text.starts_with("+-") || text.starts_with("++")) return false;
  if (read_number(text, value)) return true;
  if (text.empty() || text.find_first_not_of("+-.0123456789eE") != std::string_view::npos) return false;
  const std::string copy(text);
  char* end = nullptr;
  value = std::strtod(copy.c_str(), &end);
  return end == copy.c_str() + copy.size() && std::fabs(value) < 1;
}

}  // namespace

ColumnNames read_column_names(const std::string& option, const std::string& text) {
  ColumnNames names;
  std::istringstream pairs(text);
  for (std::string pair; std::getline(pairs, pair, ',');) {
    const std::size_t equals = pair.find('=');
    const std::string name(trimmed(pair.substr(0, equals)));
    const std::string column(equals == std::string::npos ? "" : trimmed(pair.substr(equals + 1)));
    if (name.empty() || column.empty())
      throw BadInput("{}: {}: must be NAME=COLUMN, more of them after a comma", option, shown_field(pair));
    if (!names.emplace(name, column).second) throw BadInput("{}: {} is given twice", option, name);
  }
  if (names.empty()) throw BadInput(option + ": (empty): must be NAME=COLUMN, more of them after a comma");
  return names;
}

/// Fills a table from its text, line by line.
class NumericTable::Parser {
 public:
  Parser(NumericTable& table, const TableRequest& request) : table_(table), request_(request) {}

  void parse() {
    check_names();
    const std::string_view text = table_.text_;
    const std::vector<std::string_view> lines = lines_of(without_byte_order_mark(text));
    lines_ = lines.size();
    for (const std::string_view line : lines) {
      ++line_;
      take(line, static_cast<std::size_t>(line.data() - text.data()));
    }
    if (table_.kind_.empty()) throw BadInput(table_.path_ + ": is empty, must be a CSV file with a header and rows");
    if (table_.starts_.empty()) fail(1, "no row below the header");
  }

 private:
  [[noreturn]] void fail(std::size_t column, const std::string& what) const {
    throw BadInput("{}:{}:{}: {}", table_.path_, line_, column, what);
  }

  /// Every name that --columns maps must be one that is asked for.
  void check_names() const {
    std::vector<std::string> known = request_.required;
    known.insert(known.end(), request_.optional.begin(), request_.optional.end());
    known.insert(known.end(), request_.words.begin(), request_.words.end());
    for (const auto& [name, column] : request_.names) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      throw BadInput("--columns: unknown column {}{}", shown_field(name), suggestion(name, known));
    }
  }

  void take(std::string_view line, std::size_t offset) {
    const std::size_t binary = line.find('\0');
    if (binary != std::string_view::npos) fail(binary + 1, "byte 0: must be text");
    const std::string_view words = trimmed(line);
    if (words.empty()) return;
    if (words.front() == '#') return take_comment(words.substr(1));
    if (table_.kind_.empty()) return take_header(line);
    take_row(line, offset);
  }

  void take_comment(std::string_view words) {
    const std::size_t colon = words.find(':');
    if (!table_.kind_.empty() || colon == std::string_view::npos) return;
    table_.comments_.push_back(
        {std::string(trimmed(words.substr(0, colon))), std::string(trimmed(words.substr(colon + 1))), line_});
  }

  /// A first line of numbers is a row, and the file has no header.
  void refuse_numbers(std::string_view line) const {
    CsvLine fields(line, table_.separator_);
    double value = 0;
    for (CsvField field; fields.next(field);) {
      if (!read_field(field.text, value)) return;
    }
    fail(1, "the first line has numbers, must name the columns");
  }

  void take_header(std::string_view line) {
    table_.separator_ = separator_of(line);
    refuse_numbers(line);
    CsvLine fields(line, table_.separator_);
    std::vector<std::string> header;
    for (CsvField field; fields.next(field);) {
      if (!field.closed) fail(field.column, "a quote is not closed");
      if (std::find(header.begin(), header.end(), field.text) != header.end() && !field.text.empty())
        fail(field.column, fmt::format("column {} is there twice", shown_field(field.text)));
      header.emplace_back(field.text);
    }
    table_.kind_.assign(header.size(), -1);
    for (const std::string& name : request_.words) {
      table_.kind_[place_of(name, header).value()] = -2 - static_cast<int>(table_.words_.size());
      table_.words_.push_back(name);
    }
    std::vector<std::string> wanted(header.size());
    const auto want = [&](const std::string& name, std::size_t place) {
      if (!wanted[place].empty()) {
        fail(1, fmt::format("column {} is taken for {} and for {}, must be for one ({})", shown_field(header[place]),
                            wanted[place], name, request_.renaming));
      }
      wanted[place] = name;
    };
    for (const std::string& name : request_.required) want(name, place_of(name, header).value());
    for (const std::string& name : request_.optional) {
      if (const auto place = place_of(name, header, request_.names.contains(name))) want(name, *place);
    }
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (wanted[i].empty()) continue;
      if (table_.kind_[i] != -1)
        fail(1, fmt::format("column {} cannot be both number and text", shown_field(header[i])));
      table_.kind_[i] = static_cast<int>(table_.columns_.size());
      table_.columns_.push_back(wanted[i]);
    }
    table_.starts_.reserve(lines_);
    table_.numbers_.reserve(lines_ * table_.columns_.size());
    table_.texts_.reserve(lines_ * table_.words_.size());
  }

  /// Where the file has the column that the reader knows as `name`.
  std::optional<std::size_t> place_of(const std::string& name, const std::vector<std::string>& header,
                                      bool needed = true) const {
    const auto mapped = request_.names.find(name);
    const std::string& wanted = mapped == request_.names.end() ? name : mapped->second;
    const auto place = std::find(header.begin(), header.end(), wanted);
    if (place != header.end()) return static_cast<std::size_t>(place - header.begin());
    if (!needed) return std::nullopt;
    fail(1, fmt::format("no column {}; there are {} ({})", shown_field(wanted),
                        shown_field(fmt::format("{}", fmt::join(header, " "))), request_.renaming));
  }

  void take_row(std::string_view line, std::size_t offset) {
    table_.starts_.push_back({line_, offset});
    const std::size_t row = table_.starts_.size() - 1, width = table_.kind_.size();
    table_.numbers_.resize(table_.numbers_.size() + table_.columns_.size());
    double* const numbers = table_.numbers_.data() + row * table_.columns_.size();
    CsvLine fields(line, table_.separator_);
    std::size_t count = 0;
    for (CsvField field; fields.next(field); ++count) {
      if (!field.closed) fail(field.column, "a quote is not closed");
      if (count >= width) fail(field.column, fmt::format("more fields than the header's {}", width));
      const int kind = table_.kind_[count];
      if (kind < -1) take_word(row, kind, field);
      if (kind >= 0 && !read_field(field.text, numbers[kind])) {
        fail(field.column, fmt::format("{} = {}: must be a finite number",
                                       table_.columns_[static_cast<std::size_t>(kind)], shown_field(field.text)));
      }
    }
    if (count < width) fail(line.size() + 1, fmt::format("{} fields, must be {} as in the header", count, width));
  }

  void take_word(std::size_t row, int kind, const CsvField& field) {
    const auto index = static_cast<std::size_t>(-2 - kind);
    if (field.text.empty()) fail(field.column, table_.words_[index] + " = (empty): must be a text");
    table_.texts_.resize((row + 1) * table_.words_.size());
    table_.texts_[row * table_.words_.size() + index] = field.text;
  }

  NumericTable& table_;
  const TableRequest& request_;
  std::size_t line_ = 0, lines_ = 0;
};

std::string NumericTable::text_of(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw BadInput(path + ": is a directory, must be a CSV file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw BadInput("{}: cannot be read: {}", path, std::strerror(errno));
  note_read(path);
  std::string text;
  std::vector<char> part(std::size_t{1} << 20);
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())) || file.gcount() > 0)
    text.append(part.data(), static_cast<std::size_t>(file.gcount()));
  if (file.bad()) throw BadInput("{}: cannot be read: {}", path, std::strerror(errno));
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
  return text;
}

std::vector<std::string> NumericTable::header_of(std::string_view text) {
  std::vector<std::string> names;
  for (const std::string_view line : lines_of(without_byte_order_mark(text))) {
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    CsvLine fields(line, separator_of(line));
    for (CsvField field; fields.next(field);) names.emplace_back(field.text);
    break;
  }
  return names;
}

NumericTable NumericTable::read(const std::string& path, const TableRequest& request) {
  return parse(path, text_of(path), request);
}

NumericTable NumericTable::parse(const std::string& path, std::string text, const TableRequest& request) {
  NumericTable table;
  table.path_ = path;
  table.text_ = std::move(text);
  Parser(table, request).parse();
  return table;
}

std::optional<std::string> NumericTable::comment(std::string_view key) const {
  const Comment* found = nullptr;
  for (const Comment& one : comments_) {
    if (one.key != key) continue;
    if (found != nullptr) throw BadInput("{}:{}:1: {} is given twice", path_, one.line, key);
    found = &one;
  }
  return found == nullptr ? std::nullopt : std::optional(found->value);
}

std::optional<std::size_t> NumericTable::column(std::string_view name) const {
  const auto at = std::find(columns_.begin(), columns_.end(), name);
  return at == columns_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - columns_.begin()));
}

NumericTable NumericTable::changed(const std::function<void(std::span<double>)>& change) const {
  NumericTable table = *this;
  for (std::size_t row = 0; row < rows(); ++row)
    change({table.numbers_.data() + row * columns_.size(), columns_.size()});
  return table;
}

NumericTable NumericTable::without(std::size_t first, std::size_t last) const {
  NumericTable table = *this;
  const auto erase = [&](auto& fields, std::size_t width) {
    const auto at = [&](std::size_t row) { return fields.begin() + static_cast<std::ptrdiff_t>(row * width); };
    fields.erase(at(first), at(last + 1));
  };
  erase(table.numbers_, columns_.size());
  erase(table.texts_, words_.size());
  erase(table.starts_, 1);
  return table;
}

const std::string& NumericTable::word(std::size_t row, std::string_view column) const {
  const auto at = std::find(words_.begin(), words_.end(), column);
  return texts_.at(row * words_.size() + static_cast<std::size_t>(at - words_.begin()));
}

std::pair<std::size_t, std::string> NumericTable::locate(std::size_t row, std::string_view column) const {
  const std::string_view text = text_;
  const std::size_t offset = starts_.at(row).offset;
  CsvLine fields(text.substr(offset, text.find('\n', offset) - offset), separator_);
  CsvField field;
  for (const int kind : kind_) {
    fields.next(field);
    const auto index = static_cast<std::size_t>(kind < -1 ? -2 - kind : kind);
    if (kind != -1 && (kind < -1 ? words_[index] : columns_[index]) == column) break;
  }
  return {field.column, std::string(field.text)};
}

std::string NumericTable::field(std::size_t row, std::string_view column) const { return locate(row, column).second; }

void NumericTable::refuse(std::size_t row, std::string_view column, const std::string& allowed) const {
  const auto [place, field] = locate(row, column);
  throw BadInput("{}:{}:{}: {} = {}: must be {}", path_, line(row), place, column, shown_field(field), allowed);
}

}  // namespace clatter::validation
