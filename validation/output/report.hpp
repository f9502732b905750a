// SPDX-License-Identifier: GPL-3.0-or-later
// What a command says, once for people and for other programs: tables, CSV and JSON are projections of a report.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "validation/output/json.hpp"
#include "validation/output/value.hpp"

namespace clatter::validation {

enum class Format { table, csv, json, markdown, latex };

/// A column; `name` is its name in CSV, `heading` and `unit` stand above it in tables.
struct Column {
  std::string name{};
  std::string heading{};
  std::string unit{};     ///< of CSV, JSON and tables; empty: none
  std::string meaning{};  ///< for `clatter help columns`
  bool shown = true;      ///< false: only in CSV and JSON
  bool words = false;     ///< a text, aligned to the left in tables
  std::string object{};   ///< in JSON: the group of fields that it belongs to; empty: the row's own
  std::string key{};      ///< in JSON: its name there; empty: `name`
  bool listed = false;    ///< in JSON: added to the list of that name

  [[nodiscard]] const std::string& json_key() const { return key.empty() ? name : key; }
};

/// A column of texts.
[[nodiscard]] Column word_column(const std::string& name, const std::string& heading, const std::string& meaning);
/// The column NAME_error beside a number's: in JSON NAME in the object error_estimate, in tables left out.
[[nodiscard]] Column error_column(const Column& number);

/// Columns, and after them those of `others` that have other names.
[[nodiscard]] std::vector<Column> with_more(std::vector<Column> columns, const std::vector<Column>& others);

/// A cell: its value, and how much of that a reader is shown.
struct Cell {
  Value value;
  int digits = 6;  ///< significant digits shown of a number; those not known are left out: "?" if none is known
  std::optional<std::string> shown{};  ///< in place of the value

  Cell() = default;
  Cell(double number, int known) : value(number), digits(known) {}
  Cell(Value its_value) : value(std::move(its_value)) {}  // NOLINT: a value is a cell
  template <class Number>
  requires std::is_arithmetic_v<Number> Cell(Number number) : value(number) {}  // NOLINT: a number or truth is a cell
  Cell(std::string words) : value(std::move(words)) {}                          // NOLINT: so is a text
  Cell(const char* words) : value(words) {}                                     // NOLINT
  Cell(Value its_value, std::string words) : value(std::move(its_value)), shown(std::move(words)) {}
};
using Row = std::vector<Cell>;

struct Grid {
  std::vector<Column> columns{};
  std::vector<Row> rows{};
  std::size_t leading = 1;  ///< so many shown columns say which row it is: in each block of a table that is too wide
};

/// A command that a reader may want next.
struct NamedCommand {
  std::string what, command;
};

/// What was asked, what came out, in rows and in words.
struct Report {
  std::string title;                     ///< "clatter 0.1.0, COMMAND: WHAT"
  std::vector<std::string> head;         ///< what was asked, for readers
  Value fields;                          ///< all of JSON
  Grid grid;                             ///< all of CSV; its shown columns are the table
  std::optional<Grid> further{};         ///< a second table, below the first; not in CSV
  std::optional<Grid> digest{};          ///< the table, where that has other rows
  std::vector<std::string> notes{};      ///< what came out, in words
  std::vector<std::string> remarks{};    ///< likewise, in CSV alone
  std::vector<NamedCommand> commands{};  ///< after the notes; not in JSON

  bool explains_columns = false;  ///< CSV has a line "NAME [UNIT]: MEANING" for each column

  [[nodiscard]] const Grid& table() const { return digest ? *digest : grid; }
};

struct TextStyle {
  Format format = Format::table;
  bool ascii = false;  ///< no characters beyond ASCII in tables
  bool bare = false;   ///< CSV without comments
};

/// "clatter 0.1.0, COMMAND: WHAT".
[[nodiscard]] std::string headline(const std::string& command, const std::string& what);
/// A report with its title, and in JSON the program's version.
[[nodiscard]] Report begun_report(const std::string& command, const std::string& what);

/// The report in any format.  CSV follows RFC 4180; numbers there are shortest round-trip, and what else the report
/// says comes before the names of the columns, in lines that begin with "# ".  A table takes 80 columns: what is wider
/// stands in several blocks, with all known digits.  Foreign texts are printable, except in JSON, which escapes them.
[[nodiscard]] std::string report_text(const Report& report, const TextStyle& style);
/// The part of its CSV before the rows.
[[nodiscard]] std::string csv_head(const Report& report, bool bare);
[[nodiscard]] std::string csv_text(const Report& report, bool bare);
/// A text as a field of CSV: printable, on one line, in quotes where it needs them.
[[nodiscard]] std::string csv_text(const std::string& text);

/// The columns as fields of an object for each row.
[[nodiscard]] Value row_objects(const Grid& grid);
[[nodiscard]] Value row_object(const std::vector<Column>& columns, const Row& row);

/// The title and the head.
[[nodiscard]] std::vector<std::string> head_lines(const Report& report);
/// The notes, and after them the commands, a line each.
[[nodiscard]] std::vector<std::string> notes_and_commands(const Report& report);

/// Says in the report, whose rows are those so far, that the run was interrupted.
/// @param left_out  what is missing, for a reader
void note_interrupt(const std::string& left_out, Report& report);

/// What a reader sees of a cell.
[[nodiscard]] std::string shown_text(const Cell& cell);

/// Width of a UTF-8 text in columns of a terminal.
[[nodiscard]] std::size_t display_width(const std::string& text);

/// Text broken at blanks into lines of at most `width` columns, continuation lines indented.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t width = 79, const std::string& indent = "  ");

/// A command as lines that a shell reads as one: each but the last ends in a backslash, and none has more than `width`
/// columns unless a word, quoted or not, is as long.  Lines after the first begin with `indent`.
[[nodiscard]] std::string folded_command(const std::string& command, const std::string& indent = "  ",
                                         std::size_t width = 79);

// Reports of so many rows that they are made one at a time, as often as the form needs them, and not kept.

/// Rows by their number, from 0.  A row is valid until the next one is asked for.
struct RowSource {
  std::size_t count = 0;
  std::function<const Row&(std::size_t)> row;
};

/// The text of report_text() in any form but JSON, with these rows in place of the report's: each is asked for once by
/// CSV, Markdown and LaTeX, by a table once for the widths and once for each block.
void write_rows(const Report& report, const RowSource& rows, const TextStyle& style, const WriteText& write);

/// A word of a command as a shell takes it: in quotes where it needs them.
[[nodiscard]] std::string shell_word(const std::string& word);

// Tables on a terminal: what was asked is dim, what cannot be predicted is bold.

/// The text of a report as a table: dim as far as the heading of its first block, and each "?" that stands alone bold.
[[nodiscard]] std::string with_colours(const std::string& table);

}  // namespace clatter::validation
