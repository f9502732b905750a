// Tables for people and for other programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace clatter::validation {

enum class Format { table, csv, json, markdown, latex };

/// A column; `name` is what CSV and JSON call it, `heading` and `unit` what a reader sees.
struct Column {
  std::string name;
  std::string heading;
  std::string unit;
  bool shown = true;   ///< false: only in CSV and JSON
  bool words = false;  ///< a text, aligned to the left
};

/// A cell: a number with the digits to show, a text, or nothing.
struct Cell {
  std::optional<double> number;
  int digits = 6;  ///< significant digits shown in tables; those not known are left out: "?" if none is known
  std::string text;

  Cell() = default;
  Cell(double value, int shown) : number(value), digits(shown) {}
  Cell(std::string words) : text(std::move(words)) {}  // NOLINT: a text is a cell
};

/// A table between its head (what was asked) and its notes (what came out).
struct Table {
  std::vector<std::string> head;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> notes;
};

struct TableStyle {
  Format format = Format::table;
  bool ascii = false;  ///< no characters beyond ASCII in `table`
};

/// What a reader sees of a cell.
[[nodiscard]] std::string shown_text(const Cell& cell);

/// The table in any format but JSON.  CSV follows RFC 4180 with head and notes as lines that begin with
/// "# "; numbers there are shortest round-trip.
[[nodiscard]] std::string table_text(const Table& table, const TableStyle& style);

/// Plain ASCII for the mathematical and Greek characters that the program prints.
[[nodiscard]] std::string to_ascii(const std::string& text);

/// Width of a UTF-8 text in columns of a terminal.
[[nodiscard]] std::size_t display_width(const std::string& text);

/// Text broken at blanks into lines of at most `width` columns, continuation lines indented.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t width = 79, const std::string& indent = "  ");

}  // namespace clatter::validation
