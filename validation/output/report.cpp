// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

#include "validation/output/number.hpp"
#include "validation/output/symbols.hpp"
#include "validation/output/version.hpp"

namespace clatter::validation {
namespace {

constexpr std::size_t table_width = 80;   // of a terminal
constexpr std::size_t gap = 2;            // before each column
constexpr std::size_t least_folded = 20;  // narrower texts are not folded

/// Makes a text printable in the form that is written.
using Written = std::function<std::string(const std::string&)>;

/// A shown column: which of the grid's it is, and how wide its texts stand.
struct TableColumn {
  std::size_t place = 0;
  std::string heading, unit;
  bool words = false;
  std::size_t width = 0, longest_word = 0;

  [[nodiscard]] std::size_t least_width() const {
    return std::min(width, std::max({least_folded, display_width(heading), display_width(unit)}));
  }
};
using TableColumns = std::vector<TableColumn>;

std::string cell_text(const Row& row, std::size_t place, const Written& written) {
  return place < row.size() ? written(shown_text(row[place])) : "";
}

TableColumns table_columns(const Grid& grid, const RowSource& rows, const Written& written) {
  TableColumns columns;
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    const Column& column = grid.columns[i];
    if (!column.shown) continue;
    columns.push_back({i, column.heading, column.unit, column.words,
                       std::max(display_width(column.heading), display_width(column.unit)), 0});
  }
  for (std::size_t r = 0; r < rows.count; ++r) {
    const Row& row = rows.row(r);
    for (TableColumn& column : columns) {
      const std::string text = cell_text(row, column.place, written);
      column.width = std::max(column.width, display_width(text));
      if (!column.words) continue;
      std::istringstream words(text);
      for (std::string word; words >> word;) column.longest_word = std::max(column.longest_word, display_width(word));
    }
  }
  return columns;
}

std::size_t total_width(const TableColumns& columns) {
  std::size_t total = 0;
  for (const TableColumn& column : columns) total += column.width + gap;
  return total;
}

/// Takes what is too wide from the columns of words, the widest first; words are cut where no other way is left, but
/// never those that say which row it is.
void fold_words(TableColumns& columns, std::size_t leading) {
  std::vector<TableColumn*> words;
  for (TableColumn& column : columns) {
    if (column.words) words.push_back(&column);
  }
  std::stable_sort(words.begin(), words.end(),
                   [](const TableColumn* one, const TableColumn* other) { return one->width > other->width; });
  for (const bool cuts : {false, true}) {
    for (TableColumn* const column : words) {
      const std::size_t total = total_width(columns);
      if (total <= table_width) return;
      const std::size_t least =
          std::max(column->least_width(), cuts && column->place >= leading ? 0 : column->longest_word);
      column->width -= std::min(total - table_width, column->width - std::min(least, column->width));
    }
  }
}

/// As many columns beside each other as `width` holds, at least one after the leading ones.
std::vector<TableColumns> blocks_within(std::size_t width, const TableColumns& columns, std::size_t leading) {
  const auto first = columns.begin() + static_cast<std::ptrdiff_t>(std::min(leading, columns.size()));
  const TableColumns keys(columns.begin(), first);
  std::vector<TableColumns> blocks;
  for (auto column = first; column != columns.end();) {
    TableColumns block = keys;
    do {
      block.push_back(*column++);
    } while (column != columns.end() && total_width(block) + gap + column->width <= width);
    const std::size_t total = total_width(block);
    if (total > table_width) {  // one column alone
      TableColumn& wide = block.back();
      wide.width -= std::min(total - table_width, wide.width - wide.least_width());
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// The fewest blocks that a terminal holds, the widest of them as narrow as it can be: none is left with a last column.
std::vector<TableColumns> blocks_of(const TableColumns& columns, std::size_t leading) {
  std::vector<TableColumns> blocks = blocks_within(table_width, columns, leading);
  for (std::size_t width = table_width - 1; width > 0; --width) {
    std::vector<TableColumns> narrower = blocks_within(width, columns, leading);
    if (narrower.size() > blocks.size()) break;
    blocks = std::move(narrower);
  }
  return blocks;
}

/// The first `width` columns of a text, and what is left of it.
std::string cut_off(std::string& text, std::size_t width) {
  std::size_t end = 0;
  for (std::size_t seen = 0; end < text.size(); ++end) {
    if ((text[end] & 0xC0) != 0x80 && seen++ == width) break;
  }
  std::string head = text.substr(0, end);
  text.erase(0, end);
  return head;
}

/// A text on lines of at most `width` columns; words that are longer are cut.
std::vector<std::string> folded(const std::string& text, std::size_t width) {
  if (display_width(text) <= width) return {text};
  std::vector<std::string> lines;
  std::istringstream broken(wrapped(text, width, ""));
  for (std::string line; std::getline(broken, line);) {
    while (display_width(line) > width) lines.push_back(cut_off(line, width));
    lines.push_back(line);
  }
  return lines;
}

std::string padded(const std::string& text, std::size_t width, bool words) {
  const std::string blanks(width - display_width(text), ' ');
  return words ? text + blanks : blanks + text;
}

/// One row of cells, on as many lines as the highest of them needs.
std::string row_text(const TableColumns& columns, const std::vector<std::string>& cells) {
  std::vector<std::vector<std::string>> lines;
  std::size_t height = 1;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    lines.push_back(folded(cells[i], columns[i].width));
    height = std::max(height, lines.back().size());
  }
  std::string out;
  for (std::size_t k = 0; k < height; ++k) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      line +=
          std::string(gap, ' ') + padded(k < lines[i].size() ? lines[i][k] : "", columns[i].width, columns[i].words);
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

void write_block(const TableColumns& columns, const RowSource& rows, const Written& written, const WriteText& write) {
  std::vector<std::string> headings, units;
  for (const TableColumn& column : columns) {
    headings.push_back(column.heading);
    units.push_back(column.unit);
  }
  const bool has_units = std::ranges::any_of(units, [](const std::string& unit) { return !unit.empty(); });
  std::string out = row_text(columns, headings) + (has_units ? row_text(columns, units) : "") + std::string(gap, ' ');
  for (std::size_t i = gap; i < total_width(columns); ++i) out += "─";
  write(out + "\n");
  for (std::size_t r = 0; r < rows.count; ++r) {
    const Row& row = rows.row(r);
    std::vector<std::string> cells;
    for (const TableColumn& column : columns) cells.push_back(cell_text(row, column.place, written));
    write(row_text(columns, cells));
  }
}

/// Heading, unit, a rule, and a line for each row.  Where that is wider than `table_width`, texts are folded at blanks;
/// if columns still do not fit beside each other, the rest of them follow in further blocks, each of which begins with
/// the grid's leading columns again.
void write_aligned_grid(const Grid& grid, const RowSource& rows, const Written& written, const WriteText& write) {
  const TableColumns whole = table_columns(grid, rows, written);
  TableColumns columns = whole;
  fold_words(columns, grid.leading);
  if (total_width(columns) <= table_width) return write_block(columns, rows, written, write);
  bool is_first = true;
  for (const TableColumns& block : blocks_of(whole, grid.leading)) {
    if (!is_first) write("\n");
    is_first = false;
    write_block(block, rows, written, write);
  }
}

/// The rows of a grid, which has to live as long.
RowSource rows_of(const Grid& grid) {
  return {grid.rows.size(), [&](std::size_t i) -> const Row& { return grid.rows[i]; }};
}

std::vector<std::size_t> shown_columns(const Grid& grid) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    if (grid.columns[i].shown) shown.push_back(i);
  }
  return shown;
}

void write_aligned(const Report& report, const RowSource& rows, const Written& written, const WriteText& write) {
  for (const auto& line : head_lines(report)) write(wrapped(line) + "\n");
  write_aligned_grid(report.grid, rows, written, write);
  if (report.further) {
    write("\n");
    write_aligned_grid(*report.further, rows_of(*report.further), written, write);
    write("\n");
  }
  for (const auto& line : report.notes) write(wrapped(line) + "\n");
  for (const auto& [what, command] : report.commands)
    write(what + ":\n  " + folded_command(command, "    ", 77) + "\n");
}

/// What stands about the rows of a table of the report, each text as `written` makes it.
Report shown_report(const Report& report, const Written& written) {
  Report shown;
  shown.title = written(report.title);
  shown.head = report.head;
  shown.notes = report.notes;
  shown.grid = {report.table().columns, {}, report.table().leading};
  shown.further = report.further;
  shown.commands = report.commands;
  for (auto* lines : {&shown.head, &shown.notes}) {
    for (auto& line : *lines) line = written(line);
  }
  for (NamedCommand& one : shown.commands) one = {written(one.what), written(one.command)};
  for (Grid* const grid : {&shown.grid, shown.further ? &*shown.further : nullptr}) {
    if (!grid) continue;
    for (Column& column : grid->columns) {
      column.heading = written(column.heading);
      column.unit = written(column.unit);
    }
  }
  return shown;
}

/// Each ends with two blanks, without which they would flow into one paragraph, unless they have paragraphs of their
/// own.
std::string markdown_lines(const std::vector<std::string>& lines) {
  const bool has_paragraphs = std::ranges::any_of(lines, [](const std::string& line) { return line.empty(); });
  std::string out;
  for (const auto& line : lines) out += line + (has_paragraphs ? "\n" : "  \n");
  return out;
}

void write_markdown_grid(const Grid& grid, const RowSource& rows, const Written& written, const WriteText& write) {
  const std::vector<std::size_t> columns = shown_columns(grid);
  std::string out = "\n|";
  for (const std::size_t i : columns) {
    const Column& column = grid.columns[i];
    out += " " + column.heading + (column.unit.empty() ? "" : " [" + column.unit + "]") + " |";
  }
  out += "\n|";
  for (const std::size_t column : columns) out += grid.columns[column].words ? ":---|" : "---:|";
  write(out + "\n");
  for (std::size_t r = 0; r < rows.count; ++r) {
    const Row& row = rows.row(r);
    std::string line = "|";
    for (const std::size_t i : columns) line += " " + cell_text(row, i, written) + " |";
    write(line + "\n");
  }
}

void write_markdown(const Report& report, const RowSource& rows, const Written& written, const WriteText& write) {
  write(markdown_lines(head_lines(report)));
  write_markdown_grid(report.grid, rows, written, write);
  if (report.further) write_markdown_grid(*report.further, rows_of(*report.further), written, write);
  write("\n" + markdown_lines(notes_and_commands(report)));
}

/// A number below zero begins with a minus sign, not with a hyphen.
std::string latex_cell(const std::string& text) {
  const bool is_negative = text.size() > 1 && text[0] == '-' && text[1] >= '0' && text[1] <= '9';
  return is_negative ? "$-$" + to_latex(text.substr(1)) : to_latex(text);
}

void write_latex_grid(const Grid& grid, const RowSource& rows, const Written& written, const WriteText& write) {
  const std::vector<std::size_t> columns = shown_columns(grid);
  const auto line_of = [&](const std::function<std::string(std::size_t)>& text) {
    std::string line;
    for (const std::size_t i : columns)
      line += (line.empty() && i == columns.front() ? "" : " & ") + latex_cell(text(i));
    return line + " \\\\\n";
  };
  std::string out = "\\begin{tabular}{";
  for (const std::size_t column : columns) out += grid.columns[column].words ? 'l' : 'r';
  out += "}\n\\hline\n" + line_of([&](std::size_t i) { return grid.columns[i].heading; });
  write(out + line_of([&](std::size_t i) { return grid.columns[i].unit; }) + "\\hline\n");
  for (std::size_t r = 0; r < rows.count; ++r) {
    const Row& row = rows.row(r);
    write(line_of([&](std::size_t i) { return cell_text(row, i, written); }));
  }
  write("\\hline\n\\end{tabular}\n");
}

void write_latex(const Report& report, const RowSource& rows, const Written& written, const WriteText& write) {
  for (const auto& line : head_lines(report)) write("% " + line + "\n");
  write_latex_grid(report.grid, rows, written, write);
  if (report.further) write_latex_grid(*report.further, rows_of(*report.further), written, write);
  for (const auto& line : notes_and_commands(report)) write("% " + line + "\n");
}

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

std::string csv_row(const Row& row) {
  std::string out;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto* text = std::get_if<std::string>(&row[i].value.content());
    if (i > 0) out += ',';
    if (text) out += csv_text(*text);
    else if (const double* number = row[i].value.number()) append_number(out, *number);
    else out += row[i].value.text();
  }
  return out + '\n';
}

}  // namespace

std::string headline(const std::string& command, const std::string& what) {
  return fmt::format("clatter {}, {}: {}", version, command, what);
}

Report begun_report(const std::string& command, const std::string& what) {
  Report report;
  report.title = headline(command, what);
  report.fields = Value::Fields{{"clatter", version}};
  return report;
}

std::vector<std::string> head_lines(const Report& report) {
  std::vector<std::string> lines{report.title};
  lines.insert(lines.end(), report.head.begin(), report.head.end());
  return lines;
}

std::vector<std::string> notes_and_commands(const Report& report) {
  std::vector<std::string> lines = report.notes;
  for (const auto& [what, command] : report.commands) lines.push_back(fmt::format("{}: {}", what, command));
  return lines;
}

void note_interrupt(const std::string& left_out, Report& report) {
  report.notes.push_back("interrupted: " + left_out);
  report.fields["outcome"] = "interrupted";
  report.fields["message"] = report.notes.back();
}

std::string shown_text(const Cell& cell) {
  if (cell.shown) return *cell.shown;
  if (!cell.value.number()) return cell.value.text();
  return cell.digits > 0 ? significant(*cell.value.number(), cell.digits) : "?";
}

std::size_t display_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string wrapped(const std::string& text, std::size_t width, const std::string& indent) {
  const std::size_t lead = text.find_first_not_of(' ');
  if (lead == std::string::npos || display_width(text) <= width) return text;
  std::istringstream words(text);
  std::string out, word, line(lead, ' ');
  bool first = true;
  while (words >> word) {
    if (!first && display_width(line) + 1 + display_width(word) > width) {
      out += line + "\n";
      line = std::string(lead, ' ') + indent;
      first = true;
    }
    line += (first ? "" : " ") + word;
    first = false;
  }
  return out + line;
}

std::string folded_command(const std::string& command, const std::string& indent, std::size_t width) {
  constexpr std::size_t mark = 2;  // a blank and a backslash
  std::string out, line, word;
  bool quoted = false;
  const auto take = [&] {
    if (!line.empty() && display_width(line) + 1 + display_width(word) + mark > width) {
      out += line + " \\\n";
      line = indent + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
    word.clear();
  };
  for (const char c : command) {
    if (c == '\'') quoted = !quoted;
    if (c == ' ' && !quoted) take();
    else word += c;
  }
  take();
  return out + line;
}

std::string csv_text(const std::string& given) {
  const std::string text = printable(given, Lines::kept);
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' ? ' ' : c;
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

std::vector<Column> with_more(std::vector<Column> columns, const std::vector<Column>& others) {
  for (const Column& column : others) {
    const auto is_it = [&](const Column& other) { return other.name == column.name; };
    if (std::none_of(columns.begin(), columns.end(), is_it)) columns.push_back(column);
  }
  return columns;
}

std::string csv_head(const Report& report, bool bare) {
  std::string out;
  const auto comment = [&](const std::string& line) {
    if (!bare && !line.empty()) out += "# " + printable(line) + "\n";
  };
  comment(report.title);
  for (const char* name : {"scene", "body", "parameters"}) {
    const Value* const asked = report.fields.find(name);
    if (asked && std::holds_alternative<Value::Fields>(asked->content()))
      comment(std::string(name) + ": " + compact_json(*asked));
  }
  for (const std::string& line : report.remarks) comment(line);
  for (const std::string& line : notes_and_commands(report)) comment(line);
  for (const Column& column : report.grid.columns) {
    if (report.explains_columns) comment(explanation(column));
  }
  if (!report.explains_columns) comment(units_line(report.grid.columns));
  for (std::size_t i = 0; i < report.grid.columns.size(); ++i)
    out += (i ? "," : "") + csv_text(report.grid.columns[i].name);
  return out + "\n";
}

std::string csv_text(const Report& report, bool bare) {
  std::string out = csv_head(report, bare);
  for (const Row& row : report.grid.rows) out += csv_row(row);
  return out;
}

Value row_object(const std::vector<Column>& columns, const Row& row) {
  Value object(Value::Fields{});
  for (std::size_t i = 0; i < columns.size() && i < row.size(); ++i) {
    const Column& column = columns[i];
    Value& place = (column.object.empty() ? object : object[column.object])[column.json_key()];
    if (column.listed) place.push_back(row[i].value);
    else place = row[i].value;
  }
  return object;
}

Value row_objects(const Grid& grid) {
  Value::List rows;
  for (const Row& row : grid.rows) rows.push_back(row_object(grid.columns, row));
  return rows;
}

void write_rows(const Report& report, const RowSource& rows, const TextStyle& style, const WriteText& write) {
  if (style.format == Format::csv) {
    write(csv_head(report, style.bare));
    for (std::size_t r = 0; r < rows.count; ++r) write(csv_row(rows.row(r)));
    return;
  }
  const bool ascii = style.ascii && style.format == Format::table;
  const Written written = [&](const std::string& text) {
    const std::string clean = printable(text);
    return ascii ? to_ascii(clean) : clean;
  };
  const Report shown = shown_report(report, written);
  switch (style.format) {
    case Format::markdown: return write_markdown(shown, rows, written, write);
    case Format::latex: return write_latex(shown, rows, written, write);
    default: break;
  }
  write_aligned(shown, rows, written,
                [&](std::string_view text) { write(ascii ? to_ascii(std::string(text)) : text); });
}

std::string report_text(const Report& report, const TextStyle& style) {
  if (style.format == Format::json) return json_text(report.fields);
  std::string text;
  write_rows(report, rows_of(style.format == Format::csv ? report.grid : report.table()), style,
             [&](std::string_view piece) { text += piece; });
  return text;
}

std::string shell_word(const std::string& word) {
  const char* const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,@%=:";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'') text += "'\\''";
    else text += c;
  }
  return text + "'";
}

std::string with_colours(const std::string& table) {
  std::size_t begin = table.find("──");  // the rule below heading and units
  for (int lines = 0; lines < 3 && begin != std::string::npos; ++lines)
    begin = begin == 0 ? std::string::npos : table.rfind('\n', begin - 1);
  if (begin == std::string::npos) return table;
  std::string out = "\033[2m" + table.substr(0, begin) + "\033[0m";
  for (std::size_t i = begin; i < table.size(); ++i) {
    const bool alone =
        table[i] == '?' && table[i - 1] == ' ' && i + 1 < table.size() && (table[i + 1] == ' ' || table[i + 1] == '\n');
    out += alone ? "\033[1m?\033[0m" : std::string(1, table[i]);
  }
  return out;
}

}  // namespace clatter::validation
