// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/acceleration_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/output/text_rows.hpp"
#include "validation/shock/damage_boundary.hpp"

namespace clatter::validation {
namespace {

constexpr std::size_t least_rows = 8;

constexpr double g = standard_gravity;
constexpr UnitName acceleration_units[]{
    {"g", g},     {"gn", g},    {"g_n", g},        {"mg", 1e-3 * g}, {"m/s^2", 1},   {"m/s2", 1},
    {"m/s²", 1},  {"m/s/s", 1}, {"m s^-2", 1},     {"m s-2", 1},     {"ms-2", 1},    {"ms^-2", 1},
    {"m.s-2", 1}, {"m·s⁻²", 1}, {"meters/s^2", 1}, {"mm/s^2", 1e-3}, {"m/sec^2", 1}, {"m/s**2", 1}};
constexpr UnitName time_units[]{{"s", 1},     {"sec", 1},   {"seconds", 1}, {"second", 1}, {"ms", 1e-3},
                                {"us", 1e-6}, {"µs", 1e-6}, {"μs", 1e-6},   {"ns", 1e-9},  {"min", 60}};

constexpr std::span<const UnitName> record_units[]{acceleration_units, time_units};

using RecordColumn = TextRows::Column;

bool is_time(const RecordColumn& column) {
  const std::string name = lower(column.name);
  if (factor_of(acceleration_units, column.unit)) return false;
  return name == "t" || name == "zeit" || name == "elapsed" || name == "seconds" || name == "timestamp" ||
         name.starts_with("time") || name.ends_with("time");
}

/// A size of a vector beside its parts, or a counter.
bool is_by_the_way(const RecordColumn& column) {
  const std::string name = lower(column.name);
  for (const char* word : {"abs", "total", "magnitude", "norm", "resultant", "index", "sample", "count", "number"}) {
    if (name.find(word) != std::string::npos) return true;
  }
  return name == "n" || name == "i" || name == "#";
}

/// A sampling rate in a line above the rows, "Sample rate: 1 MHz" or "Sample interval = 1e-6 s" [Hz].
std::optional<double> rate_in(std::string_view line) {
  const std::string text = lower(line);
  const bool is_rate = text.find("rate") != std::string::npos || text.find("freq") != std::string::npos;
  const bool is_interval = text.find("interval") != std::string::npos || text.find("period") != std::string::npos ||
                           text.find("increment") != std::string::npos;
  if (is_rate == is_interval) return std::nullopt;
  const std::size_t begin = text.find_first_of("0123456789.");
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t end = std::min(text.find_first_not_of("0123456789.e+-", begin), text.size());
  double value = 0;
  if (!read_number(std::string_view(text).substr(begin, end - begin), value) || !(value > 0)) return std::nullopt;
  const std::string unit(trimmed(std::string_view(text).substr(end)));
  if (is_interval) return 1 / (value * factor_of(time_units, unit.substr(0, unit.find_first_of(" ,;)"))).value_or(1));
  return value * (unit.starts_with("k") ? 1e3 : unit.starts_with("m") ? 1e6 : 1);
}

class Reader {
 public:
  explicit Reader(const RecordRequest& request)
      : request_(request),
        rows_(request.path, record_units, "a row for each instant is needed, with one to three accelerations") {}

  AccelerationRecord read() {
    if (count() < least_rows) rows_.refuse(fmt::format("{} rows: at least {} are needed", count(), least_rows));
    record_.path = request_.path;
    choose_time();
    choose_axes();
    take_times();
    take_values();
    return std::move(record_);
  }

 private:
  [[nodiscard]] std::size_t count() const { return rows_.count(); }

  [[nodiscard]] bool rises(std::size_t column) const {
    for (std::size_t i = 1; i < count(); ++i) {
      if (!(rows_.at(i, column) > rows_.at(i - 1, column))) return false;
    }
    return true;
  }

  void choose_time() {
    const bool is_named = std::any_of(rows_.columns().begin(), rows_.columns().end(),
                                      [](const RecordColumn& c) { return !std::isdigit(c.name.front()); });
    for (std::size_t k = 0; k < rows_.columns().size() && !time_; ++k) {
      if (is_time(rows_.columns()[k])) time_ = k;
    }
    if (!is_named && rows_.columns().size() > 1 && !request_.rate && rises(0)) time_ = 0;
    if (request_.rate) time_.reset();  // what was asked for, in place of a clock that is not wanted
  }

  void choose_axes() {
    for (const std::string& wanted : request_.columns) {
      const auto found = std::find_if(rows_.columns().begin(), rows_.columns().end(),
                                      [&](const RecordColumn& c) { return lower(c.name) == lower(wanted); });
      if (found == rows_.columns().end())
        rows_.refuse(fmt::format("--column {}: must be of {}", wanted, rows_.names()));
      axes_.push_back(static_cast<std::size_t>(found - rows_.columns().begin()));
    }
    for (std::size_t k = 0; request_.columns.empty() && k < rows_.columns().size(); ++k) {
      const RecordColumn& column = rows_.columns()[k];
      if (!is_time(column) && time_ != k && !is_by_the_way(column) && std::isfinite(rows_.at(0, k))) axes_.push_back(k);
    }
    const auto has_unit = [&](std::size_t k) {
      return factor_of(acceleration_units, rows_.columns()[k].unit).has_value();
    };
    if (request_.columns.empty() && std::any_of(axes_.begin(), axes_.end(), has_unit))
      std::erase_if(axes_, [&](std::size_t k) { return !has_unit(k); });
    if (axes_.empty() || axes_.size() > 3)
      rows_.refuse(fmt::format("{} columns of acceleration: --column must name one to three of {}", axes_.size(),
                               rows_.names()));
  }

  void take_times() {
    if (!time_) {
      std::optional<double> rate = request_.rate;
      for (const std::string& line : rows_.above()) rate = rate ? rate : rate_in(line);
      if (!rate)
        rows_.refuse(fmt::format("no column of time among {}: --rate HZ says how often was sampled", rows_.names()));
      for (std::size_t i = 0; i < count(); ++i) record_.times.push_back(static_cast<double>(i) / *rate);
      record_.remarks.push_back(
          fmt::format("sampled at {} Hz{}", shortest(*rate), request_.rate ? "" : ", as the lines above the rows say"));
      return;
    }
    const RecordColumn& column = rows_.columns()[*time_];
    const std::optional<double> factor = factor_of(time_units, column.unit);
    if (!factor && !column.unit.empty())
      rows_.refuse(fmt::format("column {}: unit {}: must be s, ms, us or ns", column.name, column.unit));
    for (std::size_t i = 0; i < count(); ++i) {
      if (i > 0 && !(rows_.number(i, *time_) > rows_.number(i - 1, *time_)))
        rows_.refuse(i, fmt::format("column {} = {}: must be later than in the row before", column.name,
                                    shortest(rows_.at(i, *time_))));
      record_.times.push_back((rows_.number(i, *time_) - rows_.number(0, *time_)) * factor.value_or(1));
    }
    record_.remarks.push_back(
        fmt::format("time: column {}{}", column.name, factor ? " in " + column.unit : ", taken as seconds"));
  }

  void take_values() {
    std::array<double, 3> factors{};
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const RecordColumn& column = rows_.columns()[axes_[a]];
      const std::optional<double> stated = factor_of(acceleration_units, column.unit);
      if (!stated && !request_.unit)
        rows_.refuse(fmt::format("column {}: its unit is not stated: --unit g or --unit m/s2 says it", column.name));
      factors[a] = request_.unit ? (*request_.unit == AccelerationUnit::g ? g : 1) : *stated;
      record_.axes.push_back(column.name);
    }
    for (std::size_t i = 0; i < count(); ++i) {
      Vector3& value = record_.values.emplace_back(Vector3::Zero());
      for (std::size_t a = 0; a < axes_.size(); ++a)
        value[static_cast<int>(a)] = rows_.number(i, axes_[a]) * factors[a];
    }
    const std::string& unit = rows_.columns()[axes_[0]].unit;
    record_.remarks.push_back(fmt::format(
        "acceleration: {} in {}", fmt::join(record_.axes, ", "),
        request_.unit ? (*request_.unit == AccelerationUnit::g ? "g, as --unit says" : "m/s², as --unit says") : unit));
  }

  const RecordRequest& request_;
  TextRows rows_;
  std::optional<std::size_t> time_;
  std::vector<std::size_t> axes_;
  AccelerationRecord record_;
};

}  // namespace

double AccelerationRecord::step() const {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

AccelerationRecord read_accelerations(const RecordRequest& request) { return Reader(request).read(); }

}  // namespace clatter::validation
