// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/report.hpp"

#include "validation/output/json.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation::inline output {
namespace {

/// "NAME [UNIT]: MEANING".
std::string explanation(const Column& column) {
  return column.name + " [" + (column.unit.empty() ? "1" : column.unit) + "]: " + column.meaning;
}

/// "units: start, duration [s]; …"; an error has the unit of its number.  Empty without units.
std::string units_line(const std::vector<Column>& columns) {
  std::vector<std::string> units;
  std::vector<std::string> names;
  for (const Column& column : columns) {
    if (column.unit.empty() || column.name.ends_with("_error")) continue;
    std::size_t place = 0;
    while (place < units.size() && units[place] != column.unit) ++place;
    if (place == units.size()) {
      units.push_back(column.unit);
      names.emplace_back();
    }
    names[place] += (names[place].empty() ? "" : ", ") + column.name;
  }
  std::string line;
  for (std::size_t i = 0; i < units.size(); ++i) line += (i == 0 ? "units: " : "; ") + names[i] + " [" + units[i] + "]";
  return line;
}

/// One field of a row; ends behind it and its comma.
std::string taken_field(const std::string& line, std::size_t& at, bool& is_quoted) {
  std::string field;
  is_quoted = at < line.size() && line[at] == '"';
  bool inside = is_quoted;
  if (inside) ++at;
  for (; at < line.size(); ++at) {
    const bool is_quote = is_quoted && line[at] == '"';
    if (inside && is_quote && at + 1 < line.size() && line[at + 1] == '"') field += line[++at];
    else if (is_quote) inside = false;
    else if (!inside && line[at] == ',') break;
    else field += line[at];
  }
  ++at;
  return field;
}

Cell read_cell(const std::string& field, bool is_quoted) {
  double number = 0;
  if (is_quoted) return Cell(field);
  if (read_number(field, number)) {
    Cell cell(number, 6);
    if (is_short_whole(number)) cell.shown = field;
    return cell;
  }
  if (field == "true" || field == "false") return Cell(Value(field == "true"));
  return Cell(text_or_nothing(field));
}

}  // namespace

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "\"";
}

Column word_column(const std::string& name, const std::string& heading, const std::string& meaning) {
  return {.name = name, .heading = heading, .unit = "", .meaning = meaning, .words = true};
}

Column error_column(const Column& number) {
  Column column = number;
  column.name += "_error";
  column.key = number.json_key();
  column.object = "error_estimate";
  column.meaning = "error of " + number.name;
  column.shown = false;
  return column;
}

std::string csv_head(const Report& report, bool bare) {
  std::string out;
  const auto comment = [&](const std::string& line) {
    if (!bare && !line.empty()) out += "# " + line + "\n";
  };
  comment(report.title);
  for (const char* name : {"scene", "body", "parameters"}) {
    const Value* const asked = report.fields.find(name);
    if (asked && std::holds_alternative<Value::Fields>(asked->content()))
      comment(std::string(name) + ": " + compact_json(*asked));
  }
  for (const auto* lines : {&report.remarks, &report.notes}) {
    for (const std::string& line : *lines) comment(line);
  }
  for (const Column& column : report.grid.columns) {
    if (report.explains_columns) comment(explanation(column));
  }
  if (!report.explains_columns) comment(units_line(report.grid.columns));
  for (std::size_t i = 0; i < report.grid.columns.size(); ++i) {
    out += (i ? "," : "") + csv_text(report.grid.columns[i].name);
  }
  return out + "\n";
}

std::string csv_rows(const std::vector<Row>& rows) {
  std::string out;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto* text = std::get_if<std::string>(&row[i].value.content());
      if (i > 0) out += ',';
      if (text) out += csv_text(*text);
      else if (const double* number = row[i].value.number()) append_number(out, *number);
      else out += row[i].value.text();
    }
    out += '\n';
  }
  return out;
}

std::string csv_text(const Report& report, bool bare) { return csv_head(report, bare) + csv_rows(report.grid.rows); }

std::vector<Row> read_csv_rows(const std::string& text) {
  std::vector<Row> rows;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (line.starts_with("#")) continue;
    Row& row = rows.emplace_back();
    bool is_quoted = false;
    for (std::size_t at = 0; at <= line.size();) {
      const std::string field = taken_field(line, at, is_quoted);
      row.push_back(read_cell(field, is_quoted));
    }
  }
  return rows;
}

}  // namespace clatter::validation::inline output
