// SPDX-License-Identifier: GPL-3.0-or-later
// What the sources use of C++20's library and emscripten 3.1.6 of Debian 12 lacks.  Read before each source.
#pragma once

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

namespace std {

template <class To, class From>
To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof to);
  return to;
}

/// The longest beginning that is a number, as from_chars of the standard takes it: no blank, no "+", no hexadecimal.
inline from_chars_result from_chars(const char* first, const char* last, double& value,
                                    chars_format = chars_format::general) {
  const char* end = first;
  while (end != last && std::strchr("0123456789+-.eE", *end) != nullptr && *end != '\0') ++end;
  const std::string text(first, end);
  char* stop = nullptr;
  errno = 0;
  const double number = std::strtod(text.c_str(), &stop);
  if (stop == text.c_str() || text[0] == '+') return {first, errc::invalid_argument};
  const char* const at = first + (stop - text.c_str());
  if (errno == ERANGE && !(std::fabs(number) > 0 && std::isfinite(number))) return {at, errc::result_out_of_range};
  value = number;
  return {at, errc()};
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format, int digits) {
  return {first + std::snprintf(first, static_cast<size_t>(last - first), "%.*g", digits, value), errc()};
}

inline double comp_ellint_1(double k) { return boost::math::ellint_1(k); }

namespace ranges {

/// A function of one or two values becomes one of what the projection makes of them.
template <class Function, class Projection>
auto projected(Function& function, Projection& projection) {
  return [&](const auto&... a) { return static_cast<bool>(std::invoke(function, std::invoke(projection, a)...)); };
}

#define CLATTER_RANGE(name)                                                                \
  template <class Range, class Function = std::less<>, class Projection = std::identity>   \
  auto name(Range&& range, Function function = {}, Projection projection = {}) {           \
    return std::name(std::begin(range), std::end(range), projected(function, projection)); \
  }
CLATTER_RANGE(sort)
CLATTER_RANGE(stable_sort)
CLATTER_RANGE(min_element)
CLATTER_RANGE(max_element)
CLATTER_RANGE(all_of)
CLATTER_RANGE(any_of)
CLATTER_RANGE(none_of)
CLATTER_RANGE(find_if)
CLATTER_RANGE(count_if)
#undef CLATTER_RANGE

template <class Range, class Value, class Projection = std::identity>
auto find(Range&& range, const Value& value, Projection projection = {}) {
  return ranges::find_if(
      range, [&](const auto& a) { return a == value; }, projection);
}
template <class Range, class Value>
auto count(Range&& range, const Value& value) {
  return std::count(std::begin(range), std::end(range), value);
}
template <class Range, class Out, class Condition>
auto copy_if(Range&& range, Out out, Condition condition) {
  return std::copy_if(std::begin(range), std::end(range), out, condition);
}
template <class Range, class Other>
bool is_permutation(Range&& range, Other&& other) {
  return std::is_permutation(std::begin(range), std::end(range), std::begin(other), std::end(other));
}
template <class Range, class Other, class Same = std::equal_to<>, class P = std::identity, class Q = std::identity>
bool equal(Range&& range, Other&& other, Same same = {}, P p = {}, Q q = {}) {
  return std::equal(
      std::begin(range), std::end(range), std::begin(other), std::end(other),
      [&](const auto& a, const auto& b) { return std::invoke(same, std::invoke(p, a), std::invoke(q, b)); });
}

}  // namespace ranges
}  // namespace std
