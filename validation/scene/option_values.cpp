// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/option_values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {

bool Range::holds(double value) const {
  return std::isfinite(value) && value >= low && value <= high && !(low_open && value == low);
}

std::string Range::allowed() const {
  const bool has_end = high < largest_number || low == -largest_number;
  return has_end ? words : fmt::format("{}, finite", words);
}

double read_number_option(const std::string& option, const std::string& text, const Range& range) {
  double value = 0;
  if (!read_number(text, value)) throw BadInput("{} '{}': is no number; it must be {}", option, text, range.allowed());
  if (!range.holds(value)) throw BadInput("{} '{}': must be {}", option, text, range.allowed());
  return value;
}

int read_integer_option(const std::string& option, const std::string& text, int low, int high) {
  long long value = 0;
  if (!read_integer(text, value) || value < low || value > high)
    throw BadInput("{} '{}': must be a whole number from {} to {}", option, text, low, high);
  return static_cast<int>(value);
}

std::size_t read_name_option(const std::string& option, const std::string& text,
                             const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) return i;
  }
  throw BadInput("{} '{}': must be one of {}{}", option, text, fmt::join(names, ", "), suggestion(text, names, true));
}

}  // namespace clatter::validation
