// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/number.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace clatter::validation {

double upper_median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string shortest(double value) { return fmt::format("{}", value + 0.0); }

std::string significant(double value, int digits) {
  if (value == 0) return "0";
  if (!std::isfinite(value)) return shortest(value);
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));
  if (exponent < -4 || exponent > 6) return scientific;
  return fmt::format("{:.{}f}", value, std::max(digits - 1 - exponent, 0));
}

bool is_short_whole(double value) { return value == std::round(value) && std::fabs(value) < 1e5; }

int known_digits(double value, double error) {
  constexpr int all = 17;
  if (!std::isfinite(value) || !(std::fabs(error) < std::numeric_limits<double>::infinity())) return 0;
  const double size = std::fabs(value), off = std::fabs(error);
  if (off == 0) return all;
  if (size == 0) return 0;
  const double digits = std::clamp(std::floor(std::log10(size) - std::log10(off)), 1.0, double{all});
  const double half_unit = 0.5 * std::pow(10.0, std::floor(std::log10(size)) - digits + 1);
  return static_cast<int>(digits) - (off <= half_unit ? 0 : 1);
}

namespace {

/// digits × 10^exponent, rounded once.
double decimal(int digits, int exponent) {
  // Powers of ten that are doubles.
  static constexpr double powers[]{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr int most = 22;
  if (exponent < 0 && exponent >= -most) return digits / powers[-exponent];
  if (exponent >= 0 && exponent <= most) return digits * powers[exponent];
  const std::string text = fmt::format("{}e{}", digits, exponent);
  double value = 0;
  const auto error = std::from_chars(text.data(), text.data() + text.size(), value).ec;
  return error == std::errc() || exponent < 0 ? value : std::numeric_limits<double>::infinity();
}

/// digits × 10^exponent, a double.
struct Decimal {
  int digits, exponent;
  double value;
};

/// The least one of two digits that is not below a size, which is positive and finite.
Decimal two_digits_above(double size) {
  constexpr int least = -323;  // exponent of the smallest double
  // The exponent is that of the size's second digit, or the one below: ⌊i log₁₀ 2⌋ − 1 for every exponent i of a
  // double.
  int exponent = std::max((std::ilogb(size) * 315653 >> 20) - 1, least);
  if (size > decimal(100, exponent)) ++exponent;
  constexpr int inexact = -300;  // below it decimal(1, exponent) may be subnormal, and the quotient too large
  int digits = static_cast<int>(size / decimal(1, exponent)) - (exponent < inexact ? 1 : 0);
  double shown = decimal(digits, exponent);
  while (shown < size) shown = decimal(++digits, exponent);
  return {digits, exponent, shown};
}

bool is_proper(double size) { return size > 0 && size < std::numeric_limits<double>::infinity(); }

}  // namespace

double rounded_up(double error) {
  const double size = std::fabs(error);
  return is_proper(size) ? std::copysign(two_digits_above(size).value, error) : error;
}

void append_rounded_up(std::string& out, double error) {
  const double size = std::fabs(error);
  if (!is_proper(size)) return append_number(out, error);
  auto [digits, exponent, value] = two_digits_above(size);
  while (digits % 10 == 0) digits /= 10, ++exponent;
  const int first = exponent + (digits > 9 ? 1 : 0);  // power of ten of the first digit
  // From 1e-4 on the shortest form has no exponent; below 1e-99 that has three digits.
  if (first >= -4 || first < -99 || digits > 99) return append_number(out, std::copysign(value, error));
  char text[8], *end = text;
  const auto add = [&end](int digit) { *end++ = static_cast<char>('0' + digit); };
  if (error < 0) *end++ = '-';
  if (digits > 9) add(digits / 10), *end++ = '.';
  add(digits % 10);
  *end++ = 'e', *end++ = '-';
  add(-first / 10), add(-first % 10);
  out.append(text, end);
}

bool read_number(std::string_view text, double& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, std::chars_format::general);
  return error == std::errc() && stop == end && std::isfinite(value);
}

double clean_step(double from, double step, long long i) {
  const double value = from + static_cast<double>(i) * step;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 15).ptr;
  double rounded = 0;
  return read_number({text, static_cast<std::size_t>(end - text)}, rounded) ? rounded : value;
}

long long count_of_steps(double steps) { return static_cast<long long>(std::floor(steps * (1 + 1e-12) + 1e-12)) + 1; }

double clean_ratio(double first, double last, long long i, long long count) {
  const double part = static_cast<double>(i) / static_cast<double>(count - 1);
  const double size = std::exp(std::log(std::fabs(first)) * (1 - part) + std::log(std::fabs(last)) * part);
  return clean_step(std::copysign(size, first), 0, 0);
}

void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) return;
  char text[32];
  out.append(text, fmt::format_to(text, FMT_COMPILE("{}"), value + 0.0));
}

bool read_integer(std::string_view text, long long& value) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

}  // namespace clatter::validation
