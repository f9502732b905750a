// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers from a CSV file that someone else wrote: comments, a header, rows of finite numbers.
//
//     # engine: some engine            comment "key: value", above the header
//     t,x,"z"                          header; the separator is the first of , ; tab in it
//     0,1e-3,-.5                       a row is a line; fields may be quoted ("" is a quote)
//
// Line ends are LF, CRLF or, in a text without LF, CR; a byte order mark, blank lines and lines that begin with # are
// skipped.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/output/report.hpp"

namespace clatter::validation {

// One line of a CSV file, cut into fields.

/// Without blanks at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Without a byte order mark before it.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

/// The lines of a text, without their ends.
[[nodiscard]] std::vector<std::string_view> lines_of(std::string_view text);

/// A field as an error shows it: on one line, printable, short.
[[nodiscard]] std::string shown_field(std::string_view field);

/// A field of a line: where it is and what it says, without quotes.
struct CsvField {
  std::size_t column = 1;  ///< of its first byte, from 1
  std::string_view text;   ///< valid until the next field is read
  bool quoted = false;
  bool closed = true;  ///< a quoted field has its second quote, and nothing after it
};

/// Cuts a line into fields.
class CsvLine {
 public:
  CsvLine(std::string_view line, char separator) : line_(line), separator_(separator) {}
  /// Reads the next field; false after the last one.
  bool next(CsvField& field);

 private:
  void read_quoted(std::size_t start, CsvField& field);

  std::string_view line_;
  char separator_;
  std::size_t at_ = 0;
  std::string unquoted_;  ///< a quoted field, put together
};

/// Rows that the program's own CSV holds, read back: numbers, truths and texts.
[[nodiscard]] std::vector<Row> read_csv_rows(const std::string& text);

/// Name that the reader knows → name in the file's header.
using ColumnNames = std::map<std::string, std::string>;

/// "t=time,x=pos_x" as names.  @throws BadInput naming `option` for anything else, or a name given twice.
[[nodiscard]] ColumnNames read_column_names(const std::string& option, const std::string& text);

/// What is wanted of a file.  Other columns are counted, not read.
struct TableRequest {
  std::vector<std::string> required;                          ///< columns of numbers
  std::vector<std::string> optional;                          ///< likewise, read where the file has them
  std::vector<std::string> words;                             ///< columns of texts that are not empty, required
  ColumnNames names;                                          ///< of columns that are named otherwise in the file
  std::string renaming = "--columns NAME=COLUMN maps names";  ///< how to say what a column is called, for errors
};

/// A file's rows.  Errors are one line, "FILE:LINE:COLUMN: ...", COLUMN counted in bytes from 1.
class NumericTable {
 public:
  struct Comment {
    std::string key, value;
    std::size_t line = 0;  ///< from 1
  };

  /// Reads a file; time about 0.5 µs per row and column.
  /// @throws BadInput if the file cannot be read, is a directory, is no text or has no row; for a column that is
  /// missing
  ///         or named twice, a row of another length than the header, or a field that is no finite decimal number.
  [[nodiscard]] static NumericTable read(const std::string& path, const TableRequest& request);
  /// The bytes of a file, LF in place of CR where it has no LF.  @throws BadInput if it cannot be read or is a
  /// directory.
  [[nodiscard]] static std::string text_of(const std::string& path);
  /// Names in a text's header, as the file has them; empty where there is none.
  [[nodiscard]] static std::vector<std::string> header_of(std::string_view text);
  /// The same as read() from a text; `path` is its name in errors.
  [[nodiscard]] static NumericTable parse(const std::string& path, std::string text, const TableRequest& request);

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Comments "key: value" above the header, in the file's order.
  [[nodiscard]] const std::vector<Comment>& comments() const { return comments_; }
  /// The value of a key; nothing if it is not there.  @throws BadInput if it is there twice.
  [[nodiscard]] std::optional<std::string> comment(std::string_view key) const;

  /// Names of the columns of numbers as requested, in the file's order.
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  /// Index of a column of numbers.
  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const;
  [[nodiscard]] std::size_t rows() const { return starts_.size(); }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return numbers_[row * columns_.size() + column];
  }
  /// A row's numbers, one for each of columns().
  [[nodiscard]] std::span<const double> row(std::size_t row) const {
    return {numbers_.data() + row * columns_.size(), columns_.size()};
  }
  /// The same table with each row's numbers changed.
  [[nodiscard]] NumericTable changed(const std::function<void(std::span<double>)>& change) const;
  /// The same table without rows.
  [[nodiscard]] NumericTable without(std::size_t first, std::size_t last) const;
  /// A field of a column of words.  @pre the column was requested
  [[nodiscard]] const std::string& word(std::size_t row, std::string_view column) const;
  /// A field of a column that was read, as the file has it.
  [[nodiscard]] std::string field(std::size_t row, std::string_view column) const;
  /// Line of a row, from 1.
  [[nodiscard]] std::size_t line(std::size_t row) const { return starts_[row].line; }

  /// @throws BadInput "FILE:LINE:COLUMN: NAME = FIELD: must be ALLOWED" of a field of numbers or words.
  [[noreturn]] void refuse(std::size_t row, std::string_view column, const std::string& allowed) const;

 private:
  struct Start {
    std::size_t line = 0, offset = 0;  ///< of a row's first byte in text_
  };
  class Parser;
  /// Byte of a field's line, from 1, and its text.
  [[nodiscard]] std::pair<std::size_t, std::string> locate(std::size_t row, std::string_view column) const;

  std::string path_, text_;
  char separator_ = ',';
  std::vector<Comment> comments_;
  std::vector<std::string> columns_, words_;
  std::vector<int> kind_;  ///< of each field: index in columns_; −1: not read; −2 − i: words_[i]
  std::vector<double> numbers_;
  std::vector<std::string> texts_;
  std::vector<Start> starts_;
};

}  // namespace clatter::validation
