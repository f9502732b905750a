// SPDX-License-Identifier: GPL-3.0-or-later
// One line of a CSV file, cut into fields.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "validation/output/report.hpp"

namespace clatter::validation {

/// Without blanks at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// A field as an error shows it: on one line, printable, short.
[[nodiscard]] std::string shown_field(std::string_view field);

/// The separator of a header: the first of , ; tab in it, or a comma.
[[nodiscard]] char separator_of(std::string_view header);

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

}  // namespace clatter::validation
