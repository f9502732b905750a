// SPDX-License-Identifier: GPL-3.0-or-later
// The texts of options, read and checked one by one.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace clatter::validation {

/// What a number may be.
struct Range {
  double low, high;
  bool low_open = false;  ///< low itself is not allowed
  const char* words;      ///< what is allowed, in words

  [[nodiscard]] bool holds(double value) const;
  /// The words as an error has them: where only a double's range is the end, that the number must be finite.
  [[nodiscard]] std::string allowed() const;
};

inline constexpr double largest_number = std::numeric_limits<double>::max();
inline constexpr Range any_number{-largest_number, largest_number, false, "a finite number"};
inline constexpr Range positive_number{0, largest_number, true, "greater than 0"};
inline constexpr Range not_negative_number{0, largest_number, false, "at least 0"};

/// @throws BadInput unless `text` is a finite number in `range`; `option` is as typed ("--angle").
[[nodiscard]] double read_number_option(const std::string& option, const std::string& text, const Range& range);
[[nodiscard]] int read_integer_option(const std::string& option, const std::string& text, int low, int high);
/// Index of `text` among `names`.  @throws BadInput naming the nearest.
[[nodiscard]] std::size_t read_name_option(const std::string& option, const std::string& text,
                                           const std::vector<std::string>& names);

}  // namespace clatter::validation
