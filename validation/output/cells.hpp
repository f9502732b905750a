// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of rows that are made by the million: as CSV, or packed for files of numbers and for sums over all rows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clatter::validation {

/// Appends cells to a text.  CSV: a comma before each, numbers in their shortest form.  Packed: a letter, then what it
/// announces, in the byte order of the machine:
///     d  number, a double        t  truth, 1 or 0 as a double        -  nothing
///     w  text, its length as 32 bits and its bytes
class CellWriter {
 public:
  CellWriter(std::string& out, bool packed) : out_(out), packed_(packed) {}

  /// A number; none if it is not finite.
  void number(double value);
  /// An error of a number, as rounded_up() gives it.
  void error(double value);
  void whole(long long value);
  void truth(bool value);
  void word(std::string_view text);
  void nothing(std::size_t cells = 1);
  /// What cells of another writer of the same kind appended.
  void copy(std::string_view cells) { out_ += cells; }
  void end_row() {
    if (!packed_) out_ += '\n';
  }

 private:
  void pack(double value, char kind = 'd');

  std::string& out_;
  bool packed_;
};

/// A packed cell: a text, or a number, of a truth 1 or 0, NaN if there is nothing.
struct PackedCell {
  double number;
  std::string_view text;
  bool is_text = false, is_truth = false;
};

/// Cuts a packed row, whose cells it reads one after the other.
class PackedRows {
 public:
  explicit PackedRows(std::string_view bytes) : rest_(bytes) {}
  /// Reads the cells of a row; a text is valid as long as the bytes are.
  /// @param row  as many cells as the row has
  /// @returns false at the end, and where the row is not whole
  bool next(std::vector<PackedCell>& row);
  /// Bytes that were not read: part of a row.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  bool read(PackedCell& cell, std::string_view& from) const;

  std::string_view rest_;
};

}  // namespace clatter::validation
