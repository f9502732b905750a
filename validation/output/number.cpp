#include "validation/output/number.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace clatter::validation {

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
  if (!(error > 0) || value == 0) return 17;
  const double digits = std::floor(std::log10(std::fabs(value) / error));
  return static_cast<int>(std::clamp(digits, 1.0, 17.0));
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
  return read_number({text, end}, rounded) ? rounded : value;
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
