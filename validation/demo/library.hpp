// SPDX-License-Identifier: GPL-3.0-or-later
// What the sources use of C++20's library and emscripten 3.1.6 of Debian 12 lacks.  Read before each source.
#pragma once

#include <algorithm>
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

/// By the arithmetic-geometric mean.
inline double comp_ellint_1(double k) {
  double a = 1, b = std::sqrt((1 - k) * (1 + k));
  for (int i = 0; i < 40 && std::fabs(a - b) > 4e-16 * a; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 1.5707963267948966 / a;
}

namespace ranges {

template <class Order, class Projection>
auto projected(Order& order, Projection& projection) {
  return [&](const auto& a, const auto& b) {
    return static_cast<bool>(std::invoke(order, std::invoke(projection, a), std::invoke(projection, b)));
  };
}
template <class Condition, class Projection>
auto condition_on(Condition& condition, Projection& projection) {
  return [&](const auto& a) { return static_cast<bool>(std::invoke(condition, std::invoke(projection, a))); };
}

#define CLATTER_ORDERED(name)                                                           \
  template <class Range, class Order = std::less<>, class Projection = std::identity>   \
  auto name(Range&& range, Order order = {}, Projection projection = {}) {              \
    return std::name(std::begin(range), std::end(range), projected(order, projection)); \
  }
#define CLATTER_CONDITIONAL(name)                                                              \
  template <class Range, class Condition, class Projection = std::identity>                    \
  auto name(Range&& range, Condition condition, Projection projection = {}) {                  \
    return std::name(std::begin(range), std::end(range), condition_on(condition, projection)); \
  }
CLATTER_ORDERED(sort)
CLATTER_ORDERED(stable_sort)
CLATTER_ORDERED(min_element)
CLATTER_ORDERED(max_element)
CLATTER_CONDITIONAL(all_of)
CLATTER_CONDITIONAL(any_of)
CLATTER_CONDITIONAL(none_of)
CLATTER_CONDITIONAL(find_if)
CLATTER_CONDITIONAL(count_if)
#undef CLATTER_ORDERED
#undef CLATTER_CONDITIONAL

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
