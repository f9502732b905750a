// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/estimated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

constexpr int digits_of_zero = 6;

bool is_zero(const Estimated& number, const Shown& shown) {
  const double largest = std::pow(10.0, -std::min(shown.digits, digits_of_zero)) * shown.size;
  return std::fabs(number.value) + number.error <= largest;
}

}  // namespace

Estimated& Estimated::operator+=(const Estimated& other) {
  const bool known = is_known() && other.is_known();
  value += other.value;
  error = known ? error + other.error + std::numeric_limits<double>::epsilon() / 2 * std::fabs(value) : unknown_error;
  return *this;
}

Estimated larger(const Estimated& a, const Estimated& b) {
  const bool known = a.is_known() && b.is_known();
  return {std::max(a.value, b.value), known ? std::max(a.error, b.error) : unknown_error};
}

Cell known_cell(const Estimated& number, const Shown& shown) {
  const int digits = number.is_known() ? known_digits(number.value, number.error) : 0;
  if (digits > 0) return {number.value, std::min(digits, shown.digits)};
  Cell cell(number.value, 0);
  if (number.is_known() && is_zero(number, shown)) cell.shown = "0";
  return cell;
}

Cell measured_cell(const Estimated& number, int digits) {
  constexpr int least_digits = 3, most_decimals = 6;
  Cell cell = known_cell(number, {digits, 0});
  if (!number.is_known() || known_digits(number.value, number.error) >= least_digits) return cell;
  const double error = rounded_up(number.error);
  const int decimals = std::max(1 - static_cast<int>(std::floor(std::log10(error))), 0);  // as many as the error has
  if (error < std::fabs(number.value) && decimals <= most_decimals)
    cell.shown = fmt::format("{:.{}f}±{:.{}f}", number.value, decimals, error, decimals);
  return cell;
}

std::string known_text(const Estimated& number, const Shown& shown) { return shown_text(known_cell(number, shown)); }

}  // namespace clatter::validation
