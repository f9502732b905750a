// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of numbers in a text that a logger, a spreadsheet or a testing machine wrote.
//
// Fields are divided by semicolons, tabs, commas or blanks.  Above the rows may stand the names of the columns, a line
// of their units, and other lines.  Where a comma does not divide fields it may be the decimal sign.  Blank lines and
// those that begin with #, % or // are skipped.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clatter::validation {

/// A unit as files write it, in small letters, and what one of it is in the SI's.
struct UnitName {
  const char* name;
  double factor;
};
/// The factor of a unit that is among these, in letters of either size.
[[nodiscard]] std::optional<double> factor_of(std::span<const UnitName> units, std::string_view text);

[[nodiscard]] std::string lower(std::string_view text);

class TextRows {
 public:
  /// A column, its unit empty where the text does not state it.
  struct Column {
    std::string name, unit;
  };

  /// Reads a file.
  /// @param units  those that a name may end in, "acc_g" or "strain (%)", or that a line below the names may have
  /// @param needed  what a row is, for the refusal of a text without rows
  /// @throws BadInput "FILE: ..." or "FILE:LINE:COLUMN: ..." if it cannot be read, has no rows, rows of different
  ///         lengths, or above the first row of numbers one of which a field is none.
  TextRows(const std::string& path, std::span<const std::span<const UnitName>> units, const std::string& needed);

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// The names of all columns, for messages.
  [[nodiscard]] std::string names() const;
  /// The lines above the rows, the nearest one first, as far as they belong to them.
  [[nodiscard]] const std::vector<std::string>& above() const { return above_; }
  [[nodiscard]] std::size_t count() const { return row_lines_.size(); }
  /// A field; not finite if it is no number.
  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return numbers_[row * columns_.size() + column];
  }
  /// @throws BadInput for a field that is no finite number.
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;

  /// @throws BadInput "FILE: WORDS", or of a row "FILE:LINE:1: WORDS".
  [[noreturn]] void refuse(const std::string& words) const;
  [[noreturn]] void refuse(std::size_t row, const std::string& words) const;

 private:
  [[noreturn]] void refuse_number(std::size_t line, std::size_t column, const std::string& name) const;
  /// How the fields of a row are divided, and what their decimal sign is.
  struct Layout {
    char separator = ',';
    bool decimal_comma = false;
    std::size_t fields = 0;

    /// @param places  where each field begins, from 1; null: not wanted
    [[nodiscard]] std::vector<std::string> cut(std::string_view line, std::vector<std::size_t>* places = nullptr) const;
    [[nodiscard]] bool read(std::string text, double& value) const;
    [[nodiscard]] std::size_t numbers(const std::vector<std::string>& texts) const;
  };
  struct Line {
    std::size_t number;
    std::string_view text;
  };

  [[nodiscard]] bool is_unit(std::string_view text) const;
  [[nodiscard]] Column name_and_unit(std::string_view text) const;
  [[nodiscard]] std::optional<Layout> layout_at(std::size_t line, bool with_texts) const;
  void find_rows(const std::string& needed);
  void read_head();
  [[nodiscard]] bool names_units(const std::vector<std::string>& names) const;
  void refuse_row_of_head(std::size_t line, const std::vector<std::string>& fields, bool is_named) const;
  void read_rows();

  std::string path_, text_;
  std::span<const std::span<const UnitName>> units_;
  std::vector<Line> lines_;
  Layout layout_;
  std::size_t first_ = 0;  ///< line of the first row
  std::vector<Column> columns_;
  std::vector<std::string> above_;
  std::vector<double> numbers_;  ///< of all rows
  std::vector<std::size_t> row_lines_;
};

}  // namespace clatter::validation
