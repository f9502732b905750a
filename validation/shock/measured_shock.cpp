// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/measured_shock.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/output/text_rows.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/required_spectrum.hpp"
#include "validation/shock/shock_history.hpp"
#include "validation/shock/shock_pulses.hpp"

namespace clatter::validation {

namespace {

constexpr std::size_t least_rows = 8;

constexpr double g = standard_gravity;
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

namespace {

constexpr double part_of_peak = 0.1;
constexpr double least_level = 1.5 * standard_gravity;  ///< what is below may be gravity, at rest
constexpr double least_samples = 5;                     ///< in the width of a blow whose peak is known
constexpr double least_rest = 5;                        ///< widths of the first blow over which the zero is the mean
constexpr int shown_digits = 4;                         ///< more no logger has

/// Samples begin to end − 1.
struct Stretch {
  std::size_t begin, end;
};

class BlowFinder {
 public:
  explicit BlowFinder(const AccelerationRecord& record) : record_(record) {
    for (const Vector3& value : record.values) sizes_.push_back(value.norm());
    largest_ = *std::max_element(sizes_.begin(), sizes_.end());
    if (!(largest_ > 2 * least_level)) {
      throw BadInput(fmt::format(
          "{}: no blow: the largest reading is {} g, and what is below {} g is not told from gravity", record.path,
          significant(largest_ / standard_gravity, 3), significant(2 * least_level / standard_gravity, 3)));
    }
  }

  [[nodiscard]] std::vector<MeasuredBlow> find() const {
    std::vector<Stretch> stretches;
    const double level = std::max(part_of_peak * largest_, least_level);
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      if (!(sizes_[i] > level)) continue;
      Stretch next{i, i + 1};
      while (next.end < sizes_.size() && sizes_[next.end] > level) ++next.end;
      if (!stretches.empty() && is_one(stretches.back(), next)) stretches.back().end = next.end;
      else stretches.push_back(next);
      i = next.end;
    }
    std::vector<MeasuredBlow> blows;
    for (const Stretch& stretch : stretches) blows.push_back(blow_of(stretch));
    return blows;
  }

 private:
  [[nodiscard]] double time(std::size_t i) const { return record_.times[i]; }

  [[nodiscard]] bool is_one(const Stretch& one, const Stretch& next) const {
    const double gap = time(next.begin) - time(one.end - 1);
    const double longer = std::max(time(one.end - 1) - time(one.begin), time(next.end - 1) - time(next.begin));
    return gap < longer / 2;
  }

  /// Where the size passes a level between two neighbouring samples.
  [[nodiscard]] double crossing(std::size_t below, std::size_t above, double level) const {
    return time(below) + (time(above) - time(below)) * (level - sizes_[below]) / (sizes_[above] - sizes_[below]);
  }

  /// Outward from a sample, by steps of ±1, while the size falls, for at most as long as the blow.
  [[nodiscard]] std::size_t falling(std::size_t from, int step, double longest) const {
    std::size_t i = from;
    while ((step < 0 ? i > 0 : i + 1 < sizes_.size()) && sizes_[i + static_cast<std::size_t>(step)] < sizes_[i] &&
           std::fabs(time(i) - time(from)) <= longest)
      i += static_cast<std::size_t>(step);
    return i;
  }

  /// The last sample outward, by steps of ±1, that is above the level; where the next blow begins before the reading is
  /// down there, the least one between the two.
  [[nodiscard]] std::size_t above(std::size_t from, int step, double level) const {
    std::size_t i = from, least = from;
    while (step < 0 ? i > 0 : i + 1 < sizes_.size()) {
      i += static_cast<std::size_t>(step);
      if (!(sizes_[i] > level)) return i - static_cast<std::size_t>(step);
      if (sizes_[i] < sizes_[least]) least = i;
      if (sizes_[i] > sizes_[least] + level) return least;
    }
    return i;
  }

  [[nodiscard]] MeasuredBlow blow_of(const Stretch& at) const {
    const auto peak = static_cast<std::size_t>(std::max_element(sizes_.begin() + static_cast<std::ptrdiff_t>(at.begin),
                                                                sizes_.begin() + static_cast<std::ptrdiff_t>(at.end)) -
                                               sizes_.begin());
    const double level = std::max(part_of_peak * sizes_[peak], least_level);
    const std::size_t begin = above(at.begin, -1, level), end = above(at.end - 1, 1, level);
    const bool is_low_before = begin > 0 && sizes_[begin - 1] <= level;
    const bool is_low_after = end + 1 < sizes_.size() && sizes_[end + 1] <= level;
    MeasuredBlow blow;
    blow.time = is_low_before ? crossing(begin - 1, begin, level) : time(begin);
    const double after = is_low_after ? crossing(end + 1, end, level) : time(end);
    blow.width = after - blow.time;
    blow.peak_time = time(peak) - blow.time;
    blow.first = falling(begin, -1, blow.width);
    blow.last = falling(end, 1, blow.width);
    blow.largest = peak;
    blow.peak = record_.values[peak];
    blow.peak_size = {sizes_[peak], 0};
    if (!is_low_before || !is_low_after) blow.width_error = unknown_error;
    return blow;
  }

  const AccelerationRecord& record_;
  std::vector<double> sizes_;
  double largest_ = 0;
};

Vector3 mean_of(const std::vector<Vector3>& values, std::size_t begin, std::size_t end) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return end > begin ? Vector3(sum / static_cast<double>(end - begin)) : sum;
}

class Measurement {
 public:
  Measurement(AccelerationRecord record, const ShockRequest& request) : request_(request) {
    shock_.record = std::move(record);
    if (request.filter) filter(*request.filter);
    shock_.blows = BlowFinder(shock_.record).find();
  }

  MeasuredShock take() {
    note_rest();
    for (MeasuredBlow& blow : shock_.blows) integrate(blow);
    note_clipping();
    note_narrow();
    note_gaps();
    add_spectra();
    return std::move(shock_);
  }

 private:
  [[nodiscard]] const std::vector<Vector3>& values() const { return shock_.record.values; }
  [[nodiscard]] const std::vector<double>& times() const { return shock_.record.times; }
  /// Before the filter, whose ends and lobes would move integrals, and which hides clipping.
  [[nodiscard]] const std::vector<Vector3>& read() const { return read_.empty() ? values() : read_; }

  [[nodiscard]] static Vector3 bend(const std::vector<Vector3>& of, std::size_t i) {
    if (i == 0 || i + 1 >= of.size()) return Vector3::Zero();
    return of[i + 1] - 2 * of[i] + of[i - 1];
  }

  /// Equal steps are those that times without digits enough leave: none is off by a step.
  void make_even() {
    AccelerationRecord& record = shock_.record;
    const double mean = record.times.back() / static_cast<double>(record.times.size() - 1), step = record.step();
    bool is_even = true;
    for (std::size_t i = 0; i < record.times.size(); ++i)
      is_even = is_even && std::fabs(record.times[i] - mean * static_cast<double>(i)) < mean;
    step_ = is_even ? mean : step;
    if (is_even) return;
    std::vector<double> even;
    std::vector<Vector3> between;
    for (std::size_t i = 1, n = 0; i < record.times.size(); ++i) {
      const double begin = record.times[i - 1], length = record.times[i] - begin;
      for (; static_cast<double>(n) * step <= record.times[i]; ++n) {
        even.push_back(static_cast<double>(n) * step);
        const double part = (even.back() - begin) / length;
        between.emplace_back((1 - part) * record.values[i - 1] + part * record.values[i]);
      }
    }
    record.times = even;
    record.values = between;
    shock_.findings.push_back(
        fmt::format("filter: samples at unequal times were made equal, {} s apart, by straight "
                    "lines",
                    significant(step, 4)));
  }

  void filter(const LowPass& by) {
    make_even();
    constexpr double least_rate = 6;  // of the cut-off, that is ten times the class
    if (!(by.design * step_ < 0.5))
      throw BadInput(fmt::format(
          "{}: --filter: is for more than {} samples in a second, twice the {} Hz of each pass; "
          "it has {}",
          shock_.record.path, significant(2 * by.design, 4), significant(by.design, 4), significant(1 / step_, 4)));
    if (least_rate * by.cut_off() * step_ > 1)
      shock_.findings.push_back(fmt::format("filter: sampled at {} Hz, SAE J211-1 wants six times the cut-off, {} Hz",
                                            significant(1 / step_, 4), significant(least_rate * by.cut_off(), 4)));
    shock_.record.remarks.push_back("filtered: " + by.words());
    read_ = values();
    shock_.record.values = by.filtered(read_, step_);
    gain_ = by.noise_gain(step_);
  }

  void note_rest() {
    const std::size_t first = shock_.blows.front().first, last = shock_.blows.back().last;
    // Near the blows: before a fall, or long after it, a logger may have been carried about.
    const double near = least_rest * std::max(shock_.blows.front().width, shock_.record.step());
    std::size_t begin = first, end = last + 1;
    while (begin > 0 && times()[first] - times()[begin - 1] <= near) --begin;
    while (end < values().size() && times()[end] - times()[last] <= near) ++end;
    shock_.before = mean_of(values(), begin, first);
    shock_.after = mean_of(values(), last + 1, end);
    Vector3 sum = Vector3::Zero();
    std::size_t count = 0;
    for (std::size_t i = 1; i < values().size(); ++i) {
      const bool is_quiet = std::none_of(shock_.blows.begin(), shock_.blows.end(), [&](const MeasuredBlow& blow) {
        return i > blow.first && i <= blow.last + 1;
      });
      if (!is_quiet) continue;
      sum += (read()[i] - read()[i - 1]).cwiseAbs2() / 2;
      ++count;
    }
    if (count > 0) axis_noise_ = (sum / static_cast<double>(count)).cwiseSqrt();
    shock_.noise = gain_ * axis_noise_.norm();
    const double before = shock_.before.norm(), after = shock_.after.norm();
    const std::size_t quiet_after = values().size() - last - 1;
    if (first > 2 && quiet_after > 2) {
      shock_.findings.push_back(
          fmt::format("zero: reads {} g before the first blow and {} g after the last, noise {} g", in_g(before),
                      in_g(after), in_g(shock_.noise)));
      // Free fall reads nothing and rest 1 g: what is neither has an offset, which is integrated with the blow.
      const auto offset = [](double size) { return std::min(size, std::fabs(size - standard_gravity)); };
      const double least = std::max(0.05 * standard_gravity, 3 * shock_.noise);
      if (offset(before) > least || offset(after) > least) {
        shock_.findings.push_back(
            fmt::format("the zero drifts or is off: free fall reads 0 g, rest 1 g; a velocity by integration drifts by "
                        "{} m/s in a second",
                        significant(std::max(offset(before), offset(after)), 2)));
      }
    }
  }

  [[nodiscard]] static std::string in_g(double acceleration) { return significant(acceleration / standard_gravity, 2); }

  void integrate(MeasuredBlow& blow) const {
    double sag = 0;
    for (std::size_t i = blow.first; i < blow.last; ++i) {
      const double step = times()[i + 1] - times()[i];
      blow.delta_v += step / 2 * (read()[i] + read()[i + 1]);
      sag += step / 12 * std::max(bend(read(), i).norm(), bend(read(), i + 1).norm());
    }
    const double duration = times()[blow.last] - times()[blow.first],
                 count = static_cast<double>(blow.last - blow.first);
    const double random = count > 0 ? axis_noise_.norm() * duration / std::sqrt(count) : 0;
    const double zero = std::min(shock_.before.norm(), std::fabs(shock_.before.norm() - standard_gravity));
    blow.delta_v_size = {blow.delta_v.norm(), sag + random + zero * duration};
    const std::size_t peak = blow.largest;
    double most = 0;
    for (std::size_t i = peak > 0 ? peak - 1 : 0; i <= peak + 1; ++i) most = std::max(most, bend(values(), i).norm());
    blow.peak_size.error = most / 8 + shock_.noise;
    blow.width_error += crossing_error(blow.time) + crossing_error(blow.time + blow.width);
  }

  /// By how much the instant may be off at which a straight line between two samples passes a level [s].
  [[nodiscard]] double crossing_error(double time) const {
    const auto after = std::lower_bound(times().begin(), times().end(), time);
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - times().begin(), 1));
    if (i >= times().size()) return unknown_error;
    const double step = times()[i] - times()[i - 1], rise = std::fabs(values()[i].norm() - values()[i - 1].norm());
    const double off = std::max(bend(values(), i).norm(), bend(values(), i - 1).norm()) / 8 + shock_.noise;
    return off < rise ? step * off / rise : step;
  }

  /// Three equal readings in a row, the largest or least of their axis, are an end of the logger's range.
  void note_clipping() {
    for (int axis = 0; axis < static_cast<int>(shock_.record.axes.size()); ++axis) {
      double low = 0, high = 0;
      for (const Vector3& value : read()) {
        low = std::min(low, value[axis]);
        high = std::max(high, value[axis]);
      }
      for (std::size_t b = 0; b < shock_.blows.size(); ++b) {
        MeasuredBlow& blow = shock_.blows[b];
        std::size_t run = 0, longest = 0;
        double at = 0;
        for (std::size_t i = blow.first; i <= blow.last; ++i) {
          const double value = read()[i][axis];
          const bool is_end = (value == high || value == low) && std::fabs(value) > blow.peak_size.value / 2;
          run = is_end ? run + 1 : 0;
          if (run > longest) {
            longest = run;
            at = value;
          }
        }
        if (longest < 3) continue;
        blow.peak_size.error = blow.delta_v_size.error = unknown_error;
        shock_.findings.push_back(fmt::format(
            "clipped: blow {} has {} readings in a row of {} g in {}, the end of the logger's range: peak and "
            "ΔV are larger than shown",
            b + 1, longest, significant(at / standard_gravity, 4), shock_.record.axes[static_cast<std::size_t>(axis)]));
      }
    }
  }

  void note_narrow() {
    const double step = shock_.record.step();
    std::string narrow;
    for (std::size_t b = 0; b < shock_.blows.size(); ++b) {
      MeasuredBlow& blow = shock_.blows[b];
      if (blow.width >= least_samples * step) continue;
      blow.peak_size.error = blow.width_error = unknown_error;
      narrow += fmt::format("{}{}", narrow.empty() ? "" : ", ", b + 1);
    }
    if (!narrow.empty())
      shock_.findings.push_back(fmt::format(
          "too slow a clock for blow {}: narrower than five samples, so that peak and width are not known", narrow));
  }

  void note_gaps() {
    const double step = shock_.record.step();
    std::size_t gaps = 0;
    double longest = 0;
    for (std::size_t i = 1; i < times().size(); ++i) {
      const double here = times()[i] - times()[i - 1];
      if (here > 2.5 * step) ++gaps;
      longest = std::max(longest, here);
    }
    if (gaps > 0)
      shock_.findings.push_back(fmt::format("gaps: {} between samples, the longest {} s; straight lines bridge them",
                                            gaps, significant(longest, 3)));
  }

  void add_spectra() {
    int axis = 0;
    Vector3 largest = Vector3::Zero();
    for (const MeasuredBlow& blow : shock_.blows) largest = largest.cwiseMax(blow.delta_v.cwiseAbs());
    largest.maxCoeff(&axis);
    if (request_.axis) axis = *request_.axis;
    if (axis >= static_cast<int>(shock_.record.axes.size()))
      throw BadInput(fmt::format("--axis {}: the record has {} axes", "xyz"[axis], shock_.record.axes.size()));
    const int all = static_cast<int>(shock_.blows.size());
    std::vector<int> parts{1};
    for (const int more : {std::min(request_.first, all), all}) {
      if (more > parts.back()) parts.push_back(more);
    }
    for (const int impacts : parts) {
      Spectrum spectrum{.axis = axis,
                        .blows = impacts == 1     ? Blows::impact_1
                                 : impacts == all ? Blows::all
                                                  : Blows::first,
                        .impacts = impacts,
                        .points = {}};
      std::vector<BaseSample> samples;
      const std::size_t end = impacts == all ? times().size() : shock_.blows[static_cast<std::size_t>(impacts)].first;
      for (std::size_t i = 0; i < end; ++i) samples.push_back({times()[i], values()[i][axis]});
      bool is_known = true;
      for (int b = 0; b < impacts; ++b)
        is_known = is_known && shock_.blows[static_cast<std::size_t>(b)].peak_size.is_known();
      for (const double frequency : request_.natural_frequencies()) {
        ResponsePoint point = response(samples, frequency, request_.quality, axis_noise_[axis]);
        if (!is_known) point.acceleration_error = point.pseudo_velocity_error = unknown_error;
        spectrum.points.push_back(point);
      }
      shock_.spectra.push_back(std::move(spectrum));
    }
  }

  const ShockRequest& request_;
  std::vector<Vector3> read_;             ///< before the filter; empty: there is none
  double step_ = 0, gain_ = 1;            ///< of the filter's samples [s]; what it leaves of noise
  Vector3 axis_noise_ = Vector3::Zero();  ///< standard deviation of a reading along each axis, unfiltered [m/s²]
  MeasuredShock shock_;
};

/// The probe beside the record, which is where it was taken; without one the file's name without folder and extension.
std::string record_name(const MeasuredShock& shock, const ShockRun* simulated) {
  return simulated ? simulated->probes.front().name : std::filesystem::path(shock.record.path).stem().string();
}

/// The impact of the drop that stands beside each blow, both in the order of their times from the first on: such that
/// the relative differences of the times, and `alone` for each blow or impact without another, are least in sum.
std::vector<const ShockRow*> impacts_beside(const MeasuredShock& shock, const ShockRun* simulated) {
  constexpr double alone = 0.25;  // so that of two times that stand beside each other none is twice the other
  std::vector<const ShockRow*> beside(shock.blows.size(), nullptr);
  if (!simulated) return beside;
  const std::vector<ShockRow>& rows = simulated->rows();
  const auto apart = [&](std::size_t blow, std::size_t row) {
    const double of_blow = shock.blows[blow].time - shock.blows.front().time,
                 of_row = rows[row].start - rows.front().start;
    return of_blow == of_row ? 0 : std::fabs(of_blow - of_row) / std::max(of_blow, of_row);
  };
  std::size_t i = beside.size(), j = rows.size();
  std::vector<std::vector<double>> least(i + 1, std::vector<double>(j + 1));  // of so many blows and impacts
  for (std::size_t blow = 0; blow <= i; ++blow) {
    for (std::size_t row = 0; row <= j; ++row) {
      double& sum = least[blow][row] = alone * static_cast<double>(blow + row);
      if (blow > 0 && row > 0)
        sum = std::min({least[blow - 1][row - 1] + apart(blow - 1, row - 1), least[blow - 1][row] + alone,
                        least[blow][row - 1] + alone});
    }
  }
  while (i > 0 && j > 0) {
    if (least[i][j] == least[i - 1][j - 1] + apart(i - 1, j - 1)) beside[--i] = &rows[--j];
    else if (least[i][j] == least[i - 1][j] + alone) --i;
    else --j;
  }
  return beside;
}

/// The impacts that stand beside no blow of the record, up to the last that does; empty: none.
std::string alone_words(const std::vector<const ShockRow*>& beside, const ShockRun* simulated) {
  std::string numbers;
  const auto last = std::ranges::find_if(beside.rbegin(), beside.rend(), [](const ShockRow* row) { return row; });
  for (const ShockRow* row = simulated ? simulated->rows().data() : nullptr; last != beside.rend() && row < *last;
       ++row) {
    if (std::ranges::find(beside, row) == beside.end())
      numbers += (numbers.empty() ? "" : ", ") + std::to_string(row->impact);
  }
  return numbers.empty() ? "" : "beside no blow of the record, by their times: impact " + numbers + " of the drop";
}

/// The rows of the record come first, then those of the drop beside it.
std::vector<Pulse> pulses_of(const MeasuredShock& shock, const ShockRun* simulated) {
  std::vector<Pulse> pulses;
  for (const MeasuredBlow& blow : shock.blows) {
    pulses.push_back({.probe = record_name(shock, simulated),
                      .impact = static_cast<int>(pulses.size()) + 1,
                      .velocity = blow.delta_v_size,
                      .peak = blow.peak_size,
                      .restitution = std::nan(""),
                      .model = "measured"});
  }
  if (!simulated) return pulses;
  for (const Pulse& pulse : pulses_of(*simulated)) pulses.push_back(pulse);
  return pulses;
}

Grid blows_of(const MeasuredShock& shock, const ShockRun* simulated, const std::vector<const ShockRow*>& beside) {
  Grid grid{measured_shock_columns(), {}, 1};
  for (Column& column : grid.columns) {
    column.shown = column.shown && (simulated || !column.name.starts_with("simulated"));
  }
  for (std::size_t i = 0; i < shock.blows.size(); ++i) {
    const MeasuredBlow& blow = shock.blows[i];
    const Estimated peak_g = blow.peak_size * (1 / standard_gravity), width{blow.width, blow.width_error};
    const TestPulse pulse = equivalent_pulse(blow.delta_v_size.value, blow.peak_size.value);
    Row row{Cell(i + 1), Cell(blow.time - shock.blows.front().time, 6), Cell(blow.time, 6)}, errors;
    const auto add = [&](const Estimated& number) {
      row.push_back(measured_cell(number, shown_digits));
      errors.emplace_back(error_or_nothing(number));
    };
    add(blow.delta_v_size);
    for (int axis = 0; axis < 3; ++axis) row.emplace_back(blow.delta_v[axis], shown_digits);
    add(blow.peak_size);
    add(peak_g);
    for (int axis = 0; axis < 3; ++axis) row.emplace_back(blow.peak[axis], shown_digits);
    row.emplace_back(blow.peak_time, shown_digits);
    add(width);
    const Estimated &v = blow.delta_v_size, &a = blow.peak_size;
    const double of_both = std::fabs(v.error / v.value) + std::fabs(a.error / a.value);
    row.push_back(known_or_empty(
        {pulse.duration, v.is_known() && a.is_known() ? pulse.duration * of_both : unknown_error}, shown_digits));
    row.push_back(condition_cell(v, a));
    const ShockRow* const other = beside[i];
    row.push_back(other ? Cell(other->impact) : Cell());
    row.push_back(other ? Cell(other->start - simulated->rows().front().start, 6) : Cell());
    for (const auto get : {+[](const ShockNumbers& n) { return n.delta_v_size; },
                           +[](const ShockNumbers& n) { return n.peak_size / standard_gravity; },
                           +[](const ShockNumbers& n) { return n.width; }}) {
      const bool is_there = other && get(other->value) > 0;
      row.push_back(is_there ? known_cell({get(other->value), get(other->error)}, {shown_digits, 0}) : Cell());
    }
    row.insert(row.end(), errors.begin(), errors.end());
    grid.rows.push_back(std::move(row));
  }
  return grid;
}

std::vector<NamedSpectrum> named_spectra(const MeasuredShock& shock, const ShockRun* simulated) {
  std::vector<NamedSpectrum> all;
  for (const Spectrum& spectrum : shock.spectra)
    all.push_back({record_name(shock, simulated), "measured",
                   shock.record.axes[static_cast<std::size_t>(spectrum.axis)], &spectrum});
  if (!simulated) return all;
  const bool continuous = simulated->continuous.has_value();
  for (const Blows blows : {Blows::impact_1, Blows::first, Blows::all}) {
    const Spectrum* const found = simulated->spectrum(0, continuous, blows);
    if (found)
      all.push_back({record_name(shock, simulated), continuous ? "continuous" : "discrete",
                     std::string(1, "xyz"[found->axis]), found});
  }
  return all;
}

/// "Acc Z beside body z"; empty where nothing stands beside the record.
std::string compared_axes(const std::vector<NamedSpectrum>& spectra) {
  const NamedSpectrum &measured = spectra.front(), &other = spectra.back();
  return other.model == measured.model ? "" : fmt::format("{} beside body {}", measured.axis, other.axis);
}

Value record_value(const MeasuredShock& shock) {
  const auto list = [](const Vector3& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
  return Value::Fields{{"file", shock.record.path},
                       {"axes", shock.record.axes},
                       {"samples", shock.record.times.size()},
                       {"duration", shock.record.times.back()},
                       {"step", shock.record.step()},
                       {"remarks", shock.record.remarks},
                       {"mean_before", list(shock.before)},
                       {"mean_after", list(shock.after)},
                       {"noise", shock.noise},
                       {"findings", shock.findings}};
}

/// @param simulated  a drop whose first probe reads the same; null: none
PicturePanel record_panel(const MeasuredShock& shock, const ShockRun* simulated) {
  const std::vector<double>& times = shock.record.times;
  PicturePanel panel{.columns = {{"time", "s", "after the first blow began"}}};
  panel.plot.x_label = "time after the first blow began [s]";
  panel.plot.y_label = "reading [g]";
  const double begin = shock.blows.front().time, end = shock.blows.back().time + shock.blows.back().width;
  const double room = std::max(end - begin, 4 * shock.blows.front().width) / 4;
  for (std::size_t axis = 0; axis < shock.record.axes.size(); ++axis) {
    panel.columns.push_back({fmt::format("a{}", axis + 1), "g", shock.record.axes[axis]});
    panel.plot.curves.push_back({.x = "time", .y = panel.columns.back().name, .legend = shock.record.axes[axis]});
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < begin - room || times[i] > end + room) continue;
    std::vector<double>& row = panel.rows.emplace_back(1, times[i] - begin);
    for (std::size_t axis = 0; axis < shock.record.axes.size(); ++axis)
      row.push_back(shock.record.values[i][static_cast<int>(axis)] / standard_gravity);
  }
  if (!simulated || !simulated->continuous) return panel;
  std::vector<std::vector<double>> felt;
  if (simulated->filtered.empty()) felt = felt_history(*simulated, [](const numeric::HistoryPiece&) { return true; });
  for (const FilteredHistory& history : simulated->filtered) {
    for (std::size_t i = 0; i < history.values.size(); ++i)
      felt.push_back({history.time(i), history.values[i].norm() / standard_gravity});
  }
  const double level = part_of_peak * simulated->rows().front().value.peak_size / standard_gravity;
  const auto start = std::ranges::find_if(felt, [&](const std::vector<double>& row) { return row[1] > level; });
  const double first = start == felt.end() ? 0 : start->front();
  std::erase_if(felt, [&](const std::vector<double>& row) {
    return row[0] - first < -room || row[0] - first > end - begin + room;
  });
  // A sensor's axes may lie otherwise than the body's, so that sizes are what compares; and a rigid body's peak may be
  // a hundred times what a housing passes on, beside which a record is a flat line.
  constexpr double most_times = 4;
  double recorded = 0, largest = 0;
  for (const MeasuredBlow& blow : shock.blows) recorded = std::fmax(recorded, blow.peak_size.value / standard_gravity);
  for (const std::vector<double>& row : felt) largest = std::fmax(largest, row[1]);
  if (!(largest > 0)) return panel;
  const bool is_near = largest < most_times * recorded && recorded < most_times * largest;
  const double factor = is_near ? 1 : recorded / largest;
  const std::string legend = "size, simulated" + (is_near ? "" : " × " + significant(factor, 3));
  panel.columns.push_back({"simulated", "g", legend});
  panel.plot.curves.push_back({.x = "time", .y = "simulated", .legend = legend, .style = FigureCurve::Style::dashed});
  for (std::vector<double>& row : panel.rows) row.push_back(no_number);
  for (const std::vector<double>& row : felt) {
    panel.rows.emplace_back(panel.columns.size(), no_number);
    panel.rows.back().front() = row[0] - first;
    panel.rows.back().back() = factor * row[1];
  }
  return panel;
}

}  // namespace

MeasuredShock measure_shock(AccelerationRecord record, const ShockRequest& request) {
  return Measurement(std::move(record), request).take();
}

std::vector<Column> measured_shock_columns() {
  std::vector<Column> columns{
      {"n", "n", "", "number of the blow, from 1"},
      {"start", "t", "s", "when the reading first exceeds a tenth of the peak, after that of blow 1"},
      {"time", "", "s", "the same in the record", false},
      {"delta_v", "|ΔV|", "m/s", "size of the reading's integral over the blow"},
      {"delta_v_x", "", "m/s", "its part along the first axis of the record", false},
      {"delta_v_y", "", "m/s", "its part along the second axis", false},
      {"delta_v_z", "", "m/s", "its part along the third axis", false},
      {"peak", "", "m/s²", "largest size of the reading", false},
      {"peak_g", "peak", "g", "the same in units of 9.80665 m/s²"},
      {"peak_x", "", "m/s²", "the reading along the first axis when its size is largest", false},
      {"peak_y", "", "m/s²", "along the second axis", false},
      {"peak_z", "", "m/s²", "along the third axis", false},
      {"peak_time", "", "s", "when, after the start", false},
      {"width", "width", "s", "of the blow at a tenth of its peak"},
      {"pulse_duration", "T", "s", "of the half sine with this change of velocity and peak: π |ΔV|/(2 peak)"},
      word_column("condition", "B110", "mildest service condition of JESD22-B110B that covers both; -: beyond all"),
      {"simulated_n", "", "", "number of the simulated impact beside it: the order and the times of both pair them",
       false},
      {"simulated_start", "sim. t", "s", "when that begins, after impact 1"},
      {"simulated_delta_v", "sim. |ΔV|", "m/s", "|ΔV| of the simulated probe in it"},
      {"simulated_peak_g", "sim. peak", "g", "its largest specific force"},
      {"simulated_width", "sim. width", "s", "its width at a tenth of the peak"}};
  for (const std::size_t of : {3U, 7U, 8U, 13U}) columns.push_back(error_column(columns[of]));
  return columns;
}

Report measured_shock_report(const MeasuredShock& shock, const ShockRequest& request, const ShockView& view,
                             const ShockRun* simulated) {
  Report report = begun_report("shock", "blows in a record of accelerations");
  const AccelerationRecord& record = shock.record;
  report.head.push_back(fmt::format("{}: {} samples in {} s; {}", record.path, record.times.size(),
                                    significant(record.times.back(), 4), fmt::join(record.remarks, "; ")));
  const std::vector<NamedSpectrum> spectra = named_spectra(shock, simulated);
  const std::vector<Pulse> pulses = pulses_of(shock, simulated);
  const std::vector<const ShockRow*> beside = impacts_beside(shock, simulated);
  const Grid blows = blows_of(shock, simulated, beside), pulse_rows = pulse_grid(pulses, shown_digits, view.parts);
  report.grid = view.rows == ShockRows::pulses ? pulse_rows : blows;
  if (view.rows == ShockRows::spectra) {
    report.grid = spectrum_grid(spectra, shown_digits, view);
    report.digest = spectrum_digest({spectra}, shown_digits, view);
  }
  if (view.rows == ShockRows::pulses || !view.parts.empty()) report.notes = pulse_notes(view.parts, {}, request.filter);
  if (const std::string least = least_margin_words(pulse_rows, view.parts); !least.empty())
    report.notes.push_back(least);
  if (const std::string axes = compared_axes(spectra); !axes.empty() && view.rows == ShockRows::spectra)
    report.notes.push_back(fmt::format("spectra: {}{}", axes, request.axis ? "" : ", where each changes most; --axis"));
  const std::vector<NamedSpectrum> compared = wholes_of(spectra);
  for (const std::string& words : required_words(compared, view, request.quality)) report.notes.push_back(words);
  report.notes.insert(report.notes.end(), shock.findings.begin(), shock.findings.end());
  if (const std::string alone = alone_words(beside, simulated); !alone.empty()) report.notes.push_back(alone);
  if (simulated && simulated->continuous) {
    for (const std::string& warning : simulated->continuous->planned.warnings)
      report.notes.push_back("!: warning: beside it: " + warning);
  }
  report.notes.emplace_back(
      "ΔV is the integral of the reading along the sensor's axes; gravity and turning while the blow lasts are in it");
  report.fields["model"] = "measured";
  report.fields["record"] = record_value(shock);
  report.fields["impacts"] = row_objects(blows);
  report.fields["spectra"] = spectrum_values(spectra, request.quality);
  report.fields["pulses"] = pulse_fields(pulse_rows, view.parts);
  add_spectrum_fields(compared, request, view, report);
  report.fields["simulated"] = simulated ? shock_report(*simulated, view).fields : Value();
  return report;
}

Picture measured_shock_picture(const MeasuredShock& shock, const ShockRequest& request, const ShockView& view,
                               const ShockRun* simulated) {
  Picture picture{.what = fmt::format("A record and its response spectra, {}", quality_words(request.quality)),
                  .scene = {shock.record.path},
                  .panels = {record_panel(shock, simulated)}};
  const std::vector<NamedSpectrum> spectra = named_spectra(shock, simulated);
  std::vector<PicturePanel> panels = spectrum_panels(spectra, view);
  if (const std::string axes = compared_axes(spectra); !axes.empty())
    panels.front().plot.y_label = fmt::format("{}, {} [m/s]", spectra.front().probe, axes);
  for (PicturePanel& panel : panels) picture.panels.push_back(std::move(panel));
  for (const FragilePart& part : view.parts) {
    if (auto panel = boundary_panel(pulses_of(shock, simulated), part)) picture.panels.push_back(std::move(*panel));
  }
  return picture;
}

}  // namespace clatter::validation
