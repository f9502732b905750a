// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/required_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

constexpr UnitName frequency_units[]{{"hz", 1}, {"khz", 1e3}};

std::string shown(const SpectrumMargin::End& end) {
  return fmt::format("{} dB at {} Hz", significant(std::fabs(end.decibels.value), 3), significant(end.frequency, 4));
}

/// Whether a number is at least 0.
std::optional<bool> is_positive(const Estimated& number) {
  if (!(std::fabs(number.value) >= number.error)) return std::nullopt;
  return number.value >= 0;
}

}  // namespace

std::optional<double> RequiredSpectrum::at(double frequency) const {
  const auto above = std::ranges::lower_bound(points, frequency, {}, &std::pair<double, double>::first);
  if (above == points.end()) return std::nullopt;
  if (above->first == frequency) return above->second;
  if (above == points.begin()) return std::nullopt;
  const auto& [f0, a0] = above[-1];
  const auto& [f1, a1] = *above;
  return a0 * std::pow(a1 / a0, std::log(frequency / f0) / std::log(f1 / f0));
}

RequiredSpectrum read_required_spectrum(const std::string& path) {
  const std::span<const UnitName> units[]{acceleration_units, frequency_units};
  const TextRows rows(path, units, "a frequency and an acceleration for each breakpoint are needed");
  if (rows.columns().size() != 2)
    rows.refuse(fmt::format("{} columns: must be two, a frequency and an acceleration", rows.columns().size()));
  const std::size_t f = factor_of(acceleration_units, rows.columns()[0].unit) ? 1 : 0;
  const auto acceleration = factor_of(acceleration_units, rows.columns()[1 - f].unit);
  if (!acceleration)
    rows.refuse(fmt::format("column {}: its unit must stand above the rows: {} (g), or m/s^2",
                            rows.columns()[1 - f].name, rows.columns()[1 - f].name));
  const double frequency = factor_of(frequency_units, rows.columns()[f].unit).value_or(1);
  RequiredSpectrum required{.path = path, .points = {}};
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const std::pair point{frequency * rows.number(i, f), *acceleration * rows.number(i, 1 - f)};
    if (!(point.first > 0 && point.second > 0)) rows.refuse(i, "frequency and acceleration must be greater than 0");
    if (i > 0 && !(point.first > required.points.back().first))
      rows.refuse(i, "the frequency must be greater than in the row before");
    required.points.push_back(point);
  }
  return required;
}

std::optional<bool> SpectrumMargin::is_reached() const { return is_positive(least.decibels); }

std::optional<bool> SpectrumMargin::is_kept() const {
  const auto is_over = is_positive(most.decibels);
  return is_over && most.decibels.value != 0 ? std::optional(!*is_over) : is_over;
}

std::string SpectrumMargin::words() const {
  const auto verdict = [](std::optional<bool> is, const char* yes, const char* no) {
    return !is ? "what it is worth its error leaves open" : *is ? yes : no;
  };
  const bool all_over = least.decibels.value >= 0, all_under = most.decibels.value <= 0;
  const std::string range = all_over    ? fmt::format("{} to {} above it", shown(least), shown(most))
                            : all_under ? fmt::format("{} to {} below it", shown(most), shown(least))
                                        : fmt::format("from {} below it to {} above it", shown(least), shown(most));
  return fmt::format("{}: as a test it {}; what was qualified by it {}", range,
                     verdict(is_reached(), "is met", "is not met"),
                     verdict(is_kept(), "is not exceeded", "is exceeded"));
}

Estimated decibels_over(double required, const ResponsePoint& point) {
  const double value = point.whole().acceleration.maximax();
  return {20 * std::log10(value / required), 20 * std::log10(1 + point.acceleration_error / value)};
}

std::optional<SpectrumMargin> margin_over(const RequiredSpectrum& required, const Spectrum& spectrum) {
  std::optional<SpectrumMargin> margin;
  for (const ResponsePoint& point : spectrum.points) {
    const auto asked = required.at(point.frequency);
    if (!asked) continue;
    const SpectrumMargin::End end{decibels_over(*asked, point), point.frequency};
    if (!margin) margin = {end, end};
    if (end.decibels.value < margin->least.decibels.value) margin->least = end;
    if (end.decibels.value > margin->most.decibels.value) margin->most = end;
  }
  return margin;
}

}  // namespace clatter::validation
