// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/points.hpp"

#include <Random123/philox.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/orientation.hpp"

namespace clatter::validation {

std::string unit_of(const std::string& key) {
  const auto found = std::ranges::find(all_keys(), key, &Key::name);
  return found != all_keys().end() ? found->unit : key.starts_with("body.size") ? "m" : "";
}

std::string axis_words(const std::string& key) {
  std::string words = key.substr(key.find('.') + 1);
  if (words.ends_with("_deg")) words.resize(words.size() - 4);
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == '_' || c == '.'; }, ' ');
  const std::string unit = unit_of(key);
  return unit.empty() ? words : fmt::format("{} [{}]", words, unit);
}

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

/// COUNT, the last part of a grid that has it.
long long read_count(const AxisText& given) {
  const double count = given.number(3, "COUNT");
  if (!(count >= 2) || count != std::floor(count)) given.refuse("COUNT must be a whole number from 2 on");
  if (!(count <= static_cast<double>(most_scenes))) given.refuse(too_many());
  return static_cast<long long>(count);
}

SweepAxis read_ratio_axis(const AxisText& given, const std::string& key, bool whole) {
  SweepAxis axis{.key = key, .first = given.number(0, "FROM"), .last = given.number(1, "TO"), .logarithmic = true};
  if (whole) given.refuse("a key of whole numbers has no logarithmic grid");
  if (axis.first == 0 || axis.last == 0 || (axis.first > 0) != (axis.last > 0))
    given.refuse("FROM and TO of a logarithmic grid must have one sign, and not be 0");
  axis.count = read_count(given);
  return axis;
}

SweepAxis read_even_axis(const AxisText& given, const std::string& key, bool whole) {
  SweepAxis axis{.key = key, .first = given.number(0, "FROM"), .last = given.number(1, "TO"), .whole = whole};
  axis.count = read_count(given);
  axis.step = (axis.last - axis.first) / static_cast<double>(axis.count - 1);
  if (axis.step == 0) given.refuse("FROM and TO must differ");
  if (whole && axis.step != std::floor(axis.step)) given.refuse("COUNT must leave whole numbers between FROM and TO");
  return axis;
}

/// What a file or a list of attitudes must have.
std::string attitude_words() { return key_named("drop.attitude").allowed(); }

constexpr const char* parameter_names[] = {"q0", "q1", "q2", "q3"};

std::vector<SweptAttitude> attitudes_of_file(const std::string& path) {
  TableRequest request;
  request.required.assign(std::begin(parameter_names), std::end(parameter_names));
  const NumericTable table = NumericTable::read(path, request);
  std::vector<SweptAttitude> attitudes(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t i = 0; i < 4; ++i) attitudes[row][i] = table.at(row, *table.column(parameter_names[i]));
    if (!is_attitude(attitudes[row])) table.refuse(row, "q0", attitude_words());
  }
  return attitudes;
}

/// The number that a text is; NaN: none.
double parameter_in(const std::string& text) {
  double number = 0;
  return read_number(text, number) ? number : std::nan("");
}

/// "q0,q1,q2,q3", without its brackets.
SweptAttitude read_attitude(const std::string& text) {
  SweptAttitude q{};
  std::size_t begin = 0;
  for (double& parameter : q) {
    const bool is_last = &parameter == &q.back();
    const std::size_t end = is_last ? text.size() : std::min(text.find(',', begin), text.size());
    parameter = parameter_in(text.substr(std::min(begin, text.size()), end - std::min(begin, text.size())));
    begin = end + 1;
  }
  return q;
}

std::vector<SweptAttitude> attitudes_in_brackets(const std::string& key, const std::string& text) {
  std::vector<SweptAttitude> attitudes;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(']', begin), text.size());
    const std::string given = text.substr(begin, std::min(end + 1, text.size()) - begin);
    const bool is_closed = given.size() > 2 && given.front() == '[' && given.back() == ']';
    const SweptAttitude q = is_closed ? read_attitude(given.substr(1, given.size() - 2)) : SweptAttitude{};
    const std::size_t next = std::min(end + 1, text.size());
    const bool goes_on = next + 1 < text.size() && text[next] == ',';
    if (!is_attitude(q) || (next < text.size() && !goes_on)) {
      throw BadInput(fmt::format("--set {}: attitude {}, '{}': must be [q0,q1,q2,q3], {}", key, attitudes.size() + 1,
                                 given, attitude_words()));
    }
    attitudes.push_back(q);
    begin = next + 1;
  }
  return attitudes;
}

}  // namespace

SweptAttitude uniform_attitude(const std::array<double, 3>& parts) {
  const double first = std::sqrt(1 - parts[0]), second = std::sqrt(parts[0]);
  const double one = 2 * std::numbers::pi * parts[1], other = 2 * std::numbers::pi * parts[2];
  SweptAttitude q{second * std::cos(other), first * std::sin(one), first * std::cos(one), second * std::sin(other)};
  if (q[0] < 0) std::for_each(q.begin(), q.end(), [](double& parameter) { parameter = -parameter; });
  return q;
}

double uniform_at(std::uint64_t seed, std::uint64_t scene, std::uint32_t column, std::uint32_t draw) {
  const auto high = [](std::uint64_t number) { return static_cast<std::uint32_t>(number >> 32); };
  const auto low = [](std::uint64_t number) { return static_cast<std::uint32_t>(number); };
  const auto words = r123::Philox4x32{}({{low(scene), high(scene), column, draw}}, {{low(seed), high(seed)}});
  return static_cast<double>((std::uint64_t{words[0]} << 32 | words[1]) >> 11) * 0x1p-53;
}

SweptAttitude turned(const SweptAttitude& attitude, const std::array<double, 3>& vector) {
  const double angle = std::hypot(vector[0], vector[1], vector[2]);
  if (angle == 0) return attitude;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Eigen::Vector3d(vector[0], vector[1], vector[2]) / angle));
  const Eigen::Quaterniond q =
      (turn * Eigen::Quaterniond(attitude[0], attitude[1], attitude[2], attitude[3])).normalized();
  return {q.w(), q.x(), q.y(), q.z()};
}

std::vector<std::string> SweepAxis::names() const {
  if (!is_attitude()) return {key};
  std::vector<std::string> columns;
  for (const char* const parameter : parameter_names) columns.push_back(fmt::format("{}_{}", key, parameter));
  return columns;
}

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
  if (parts == 4 && given.parts()[2] == "lin") return read_even_axis(given, key, whole);
  if (parts == 3 && (given.parts()[2] == "log" || given.parts()[2] == "lin")) {
    const std::string& kind = given.parts()[2];
    given.refuse(fmt::format("{} needs a COUNT, FROM:TO:{}:COUNT{}", kind, kind,
                             kind == "log" ? "; LOW:HIGH:log is drawn with --random N" : ""));
  }
  if (parts != 3) given.refuse("must be VALUE, A,B,..., FROM:TO:STEP, FROM:TO:lin:COUNT or FROM:TO:log:COUNT");
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
  if (parts < 2 || parts > 3 || (parts == 3 && given.parts()[2] != "log"))
    given.refuse("must be VALUE, LOW:HIGH or LOW:HIGH:log with --random");
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

SweepAxis read_attitude_axis(const std::string& key, const std::string& text) {
  SweepAxis axis{.key = key};
  axis.attitudes = text.starts_with('@') ? attitudes_of_file(text.substr(1)) : attitudes_in_brackets(key, text);
  axis.count = static_cast<long long>(axis.attitudes.size());
  return axis;
}

PickedScenes read_scenes(const std::string& text, long long count) {
  const auto refuse = [&](const std::string& why) { throw BadInput(fmt::format("--scenes '{}': {}", text, why)); };
  std::vector<long long> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    if (!read_integer(text.substr(begin, end - begin), numbers.emplace_back())) numbers.back() = -1;
    begin = end + 1;
  }
  if (numbers.size() == 2) numbers.push_back(1);
  const bool are_scenes =
      numbers.size() == 3 && 0 <= numbers[0] && numbers[0] < count && 0 <= numbers[1] && numbers[1] < count;
  if (!are_scenes || numbers[2] < 1)
    refuse(fmt::format("must be FROM:TO or FROM:TO:STEP, whole numbers, FROM and TO from 0 to {}, STEP from 1",
                       count - 1));
  if (numbers[0] > numbers[1]) refuse("FROM must not be greater than TO");
  return {.first = numbers[0], .count = (numbers[1] - numbers[0]) / numbers[2] + 1, .step = numbers[2]};
}

SweepPoints::SweepPoints(std::vector<SweepAxis> grid) : axes_(std::move(grid)) {
  for (const SweepAxis& axis : axes_) {
    if (axis.count > most_scenes / count_) throw BadInput(fmt::format("--set {}: {} in all", axis.key, too_many()));
    count_ *= axis.count;
  }
}

SweepPoints::SweepPoints(std::vector<SweepAxis> ranges, long long count, std::uint64_t seed)
    : axes_(std::move(ranges)), count_(count), random_(true), seed_(seed) {}

long long SweepPoints::attitudes() const {
  for (const SweepAxis& axis : axes_) {
    if (!axis.attitudes.empty()) return static_cast<long long>(axis.attitudes.size());
  }
  return 0;
}

long long SweepPoints::attitude_of(long long point) const {
  if (attitudes() == 0) return 0;
  for (std::size_t i = axes_.size(); !random_ && i-- > 0 && axes_[i].attitudes.empty();) point /= axes_[i].count;
  return point % attitudes();
}

void SweepPoints::draw(long long point, std::size_t axis, double* values) const {
  const auto part = [&](std::uint32_t draw) {
    return uniform_at(seed_, static_cast<std::uint64_t>(point), static_cast<std::uint32_t>(axis), draw);
  };
  const SweepAxis& drawn = axes_[axis];
  if (drawn.any_attitude) {
    std::ranges::copy(uniform_attitude({part(0), part(1), part(2)}), values);
  } else if (drawn.is_attitude()) {
    // Two normal numbers from two uniform ones, by Box and Muller; 1 − part is never 0.
    const auto normal = [&](std::uint32_t first, bool sine) {
      const double size = drawn.scatter * std::sqrt(-2 * std::log(1 - part(first)));
      const double angle = 2 * std::numbers::pi * part(first + 1);
      return size * (sine ? std::sin(angle) : std::cos(angle));
    };
    const auto base = static_cast<std::size_t>(point % static_cast<long long>(drawn.attitudes.size()));
    std::ranges::copy(turned(drawn.attitudes[base], {normal(0, false), normal(0, true), normal(2, false)}), values);
  } else {
    *values = drawn.drawn(part(0));
  }
}

void SweepPoints::at(long long point, std::vector<double>& values) const {
  std::size_t end = 0;
  for (const SweepAxis& axis : axes_) end += axis.width();
  values.resize(end);
  for (std::size_t i = axes_.size(); i-- > 0;) {
    const SweepAxis& axis = axes_[i];
    double* const place = values.data() + (end -= axis.width());
    if (random_) {
      draw(point, i, place);
      continue;
    }
    const long long value = point % axis.count;
    if (axis.is_attitude()) std::ranges::copy(axis.attitudes[static_cast<std::size_t>(value)], place);
    else *place = axis.at(value);
    point /= axis.count;
  }
}

}  // namespace clatter::validation
