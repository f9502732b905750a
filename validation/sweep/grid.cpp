// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/sweep/counter_random.hpp"

namespace clatter::validation::inline sweep {
namespace {

constexpr double largest_whole = 0x1p53;

/// The texts between the separators of one --set.
class AxisText {
 public:
  AxisText(const std::string& key, const std::string& text, bool whole, char separator = ':')
      : key_(key), text_(text), whole_(whole) {
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(separator, begin), text.size());
      parts_.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  [[nodiscard]] const std::vector<std::string>& parts() const { return parts_; }

  [[nodiscard]] double number(std::size_t part, const char* name) const {
    double value = 0;
    if (!read_number(parts_[part], value)) refuse(fmt::format("{} must be a finite number", name));
    const bool fits = std::fabs(value) <= largest_whole && value == std::floor(value);
    if (whole_ && !fits) refuse(fmt::format("{} must be a whole number", name));
    return value;
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw BadInput(fmt::format("--set {}={}: {}", key_, text_, why));
  }

 private:
  const std::string &key_, &text_;
  bool whole_;
  std::vector<std::string> parts_;
};

std::string too_many() { return fmt::format("more than {} scenes", most_scenes); }

SweepAxis read_listed_axis(const std::string& key, const std::string& text, bool whole) {
  const AxisText given(key, text, whole, ',');
  SweepAxis axis{.key = key, .count = static_cast<long long>(given.parts().size()), .whole = whole};
  for (std::size_t i = 0; i < given.parts().size(); ++i) axis.listed.push_back(given.number(i, "each value of a list"));
  const auto [least, most] = std::minmax_element(axis.listed.begin(), axis.listed.end());
  axis.first = *least;
  axis.last = *most;
  return axis;
}

SweepAxis read_ratio_axis(const AxisText& given, const std::string& key, bool whole) {
  SweepAxis axis{.key = key, .first = given.number(0, "FROM"), .last = given.number(1, "TO"), .logarithmic = true};
  if (whole) given.refuse("a key of whole numbers has no logarithmic grid");
  if (axis.first == 0 || axis.last == 0 || (axis.first > 0) != (axis.last > 0)) {
    given.refuse("FROM and TO of a logarithmic grid must have one sign, and not be 0");
  }
  const double count = given.number(3, "COUNT");
  if (!(count >= 2) || count != std::floor(count)) given.refuse("COUNT must be a whole number from 2 on");
  if (!(count <= static_cast<double>(most_scenes))) given.refuse(too_many());
  axis.count = static_cast<long long>(count);
  return axis;
}

}  // namespace

double SweepAxis::at(long long i) const {
  if (!listed.empty()) return listed[static_cast<std::size_t>(i)];
  if (i == 0) return first;
  if (logarithmic) return i == count - 1 ? last : clean_ratio(first, last, i, count);
  const double value = clean_step(first, step, i);
  return step > 0 ? std::fmin(value, last) : std::fmax(value, last);
}

double SweepAxis::drawn(double part) const {
  if (whole) return first + std::fmin(std::floor(part * (last - first + 1)), last - first);
  if (!logarithmic) return std::clamp(first * (1 - part) + last * part, first, last);
  return std::clamp(std::exp(std::log(first) * (1 - part) + std::log(last) * part), first, last);
}

SweepAxis read_grid_axis(const std::string& key, const std::string& text, bool whole) {
  if (text.find(',') != std::string::npos) return read_listed_axis(key, text, whole);
  const AxisText given(key, text, whole);
  const std::size_t parts = given.parts().size();
  if (parts == 4 && given.parts()[2] == "log") return read_ratio_axis(given, key, whole);
  if (parts != 3) given.refuse("must be VALUE, A,B,..., FROM:TO:STEP or FROM:TO:log:COUNT");
  SweepAxis axis{
      .key = key, .first = given.number(0, "FROM"), .last = 0, .step = given.number(2, "STEP"), .whole = whole};
  const double to = given.number(1, "TO");
  if (axis.step == 0) given.refuse("STEP must not be 0");
  const double steps = (to - axis.first) / axis.step;
  if (!(steps >= 0)) given.refuse("STEP must have the sign of TO - FROM");
  if (!(steps < static_cast<double>(most_scenes))) given.refuse(too_many());
  axis.count = count_of_steps(steps);
  axis.last = to;
  axis.last = axis.at(axis.count - 1);
  return axis;
}

SweepAxis read_random_axis(const std::string& key, const std::string& text, bool whole) {
  const AxisText given(key, text, whole);
  const std::size_t parts = given.parts().size();
  if (parts < 2 || parts > 3 || (parts == 3 && given.parts()[2] != "log")) {
    given.refuse("must be VALUE, LOW:HIGH or LOW:HIGH:log with --random");
  }
  const SweepAxis axis{.key = key,
                       .first = given.number(0, "LOW"),
                       .last = given.number(1, "HIGH"),
                       .logarithmic = parts == 3,
                       .whole = whole};
  if (!(axis.first <= axis.last)) given.refuse("LOW must not be greater than HIGH");
  if (axis.logarithmic && whole) given.refuse("a key of whole numbers has no logarithmic range");
  if (axis.logarithmic && !(axis.first > 0)) given.refuse("LOW must be greater than 0 in a logarithmic range");
  return axis;
}

SweepPoints::SweepPoints(std::vector<SweepAxis> grid) : axes_(std::move(grid)) {
  for (const SweepAxis& axis : axes_) {
    if (axis.count > most_scenes / count_) throw BadInput(fmt::format("--set {}: {} in all", axis.key, too_many()));
    count_ *= axis.count;
  }
}

SweepPoints::SweepPoints(std::vector<SweepAxis> ranges, long long count, std::uint64_t seed)
    : axes_(std::move(ranges)), count_(count), random_(true), seed_(seed) {}

void SweepPoints::at(long long point, std::vector<double>& values) const {
  values.resize(axes_.size());
  for (std::size_t i = axes_.size(); i-- > 0;) {
    const SweepAxis& axis = axes_[i];
    if (random_) {
      values[i] = axis.drawn(uniform_at(seed_, static_cast<std::uint64_t>(point), static_cast<std::uint32_t>(i)));
      continue;
    }
    values[i] = axis.at(point % axis.count);
    point /= axis.count;
  }
}

}  // namespace clatter::validation::inline sweep
