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
#include "validation/shock/damage_boundary.hpp"

namespace clatter::validation {
namespace {

constexpr std::size_t least_rows = 8;

using Texts = std::vector<std::string>;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

bool is_comment(std::string_view line) {
  return line.empty() || line.front() == '#' || line.front() == '%' || line.starts_with("//");
}

/// How the fields of a row are divided, and what their decimal sign is.
struct Layout {
  char separator = ',';
  bool decimal_comma = false;
  std::size_t fields = 0;

  [[nodiscard]] Texts cut(std::string_view line) const {
    Texts texts;
    if (separator == ' ') {
      for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
        texts.emplace_back(line.substr(at, end - at));
        at = line.find_first_not_of(" \t", end);
      }
      return texts;
    }
    CsvLine fields_of(line, separator);
    for (CsvField field; fields_of.next(field);) texts.emplace_back(field.text);
    if (texts.size() > 1 && texts.back().empty()) texts.pop_back();  // a separator at the end of a line
    return texts;
  }

  [[nodiscard]] bool read(std::string text, double& value) const {
    if (decimal_comma) std::replace(text.begin(), text.end(), ',', '.');
    return read_number(text, value);
  }

  /// How many of the fields are numbers.
  [[nodiscard]] std::size_t numbers(const Texts& texts) const {
    double value = 0;
    return static_cast<std::size_t>(
        std::count_if(texts.begin(), texts.end(), [&](const auto& text) { return read(text, value); }));
  }
};

struct TextLine {
  std::size_t number;
  std::string_view text;
};

std::vector<TextLine> lines_of(std::string_view text) {
  text = without_byte_order_mark(text);
  std::vector<TextLine> lines;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back({++number, trimmed(text.substr(begin, end - begin))});
    begin = end + 1;
  }
  return lines;
}

/// The layout in which this line is a row of numbers, or of texts among numbers, and so is the next one that is no
/// comment.
std::optional<Layout> layout_at(const std::vector<TextLine>& lines, std::size_t at, bool with_texts) {
  std::size_t next = at + 1;
  while (next < lines.size() && is_comment(lines[next].text)) ++next;
  if (next == lines.size()) return std::nullopt;
  for (const char separator : {';', '\t', ',', ' '}) {
    for (const bool decimal_comma : {false, true}) {
      if (decimal_comma && separator == ',') continue;
      Layout layout{separator, decimal_comma};
      const Texts first = layout.cut(lines[at].text), second = layout.cut(lines[next].text);
      // A lone field with a comma may as well be two fields.
      if (first.size() != second.size() || (decimal_comma && first.size() < 2)) continue;
      const std::size_t least = with_texts ? std::min<std::size_t>(first.size(), 2) : first.size();
      if (first.empty() || layout.numbers(first) < least || layout.numbers(second) < least) continue;
      layout.fields = first.size();
      return layout;
    }
  }
  return std::nullopt;
}

struct UnitName {
  const char* name;
  double factor;
};
constexpr double g = standard_gravity;
constexpr UnitName acceleration_units[]{
    {"g", g},     {"gn", g},    {"g_n", g},        {"mg", 1e-3 * g}, {"m/s^2", 1},   {"m/s2", 1},
    {"m/s²", 1},  {"m/s/s", 1}, {"m s^-2", 1},     {"m s-2", 1},     {"ms-2", 1},    {"ms^-2", 1},
    {"m.s-2", 1}, {"m·s⁻²", 1}, {"meters/s^2", 1}, {"mm/s^2", 1e-3}, {"m/sec^2", 1}, {"m/s**2", 1}};
constexpr UnitName time_units[]{{"s", 1},     {"sec", 1},   {"seconds", 1}, {"second", 1}, {"ms", 1e-3},
                                {"us", 1e-6}, {"µs", 1e-6}, {"μs", 1e-6},   {"ns", 1e-9},  {"min", 60}};

template <std::size_t Count>
std::optional<double> factor_of(const UnitName (&units)[Count], std::string_view text) {
  const std::string name = lower(text);
  for (const UnitName& unit : units) {
    if (name == unit.name) return unit.factor;
  }
  return std::nullopt;
}

/// "Acceleration x (m/s^2)" or "ax [g]" or "acc_g" cut into name and unit; without one the unit is empty.
std::pair<std::string, std::string> name_and_unit(std::string_view text) {
  text = trimmed(text);
  for (const auto& [open, close] : {std::pair{'(', ')'}, {'[', ']'}}) {
    const std::size_t begin = text.rfind(open), end = text.rfind(close);
    if (begin != std::string_view::npos && end != std::string_view::npos && end > begin)
      return {std::string(trimmed(text.substr(0, begin))),
              std::string(trimmed(text.substr(begin + 1, end - begin - 1)))};
  }
  for (const char mark : {'_', ' ', '/'}) {
    const std::size_t at = text.find(mark);
    if (at == std::string_view::npos || at == 0) continue;
    const std::string_view unit = trimmed(text.substr(at + 1));
    if (factor_of(acceleration_units, unit) || factor_of(time_units, unit))
      return {std::string(trimmed(text.substr(0, at))), std::string(unit)};
  }
  return {std::string(trimmed(text)), ""};
}

struct RecordColumn {
  std::string name, unit;
};

/// Without brackets about it.
std::string_view bare(std::string_view text) {
  const bool is_bracketed = text.size() > 2 && (text.front() == '[' || text.front() == '(');
  return is_bracketed ? trimmed(text.substr(1, text.size() - 2)) : text;
}

bool is_unit(std::string_view text) {
  text = bare(text);
  return text.empty() || text == "-" || factor_of(acceleration_units, text) || factor_of(time_units, text);
}

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

/// What stands above the rows.
struct Head {
  std::vector<RecordColumn> columns;
  std::optional<double> rate;
};

Head head_of(const std::vector<TextLine>& lines, std::size_t first, const Layout& layout) {
  Head head;
  std::vector<Texts> above;  // lines with as many fields, the nearest one first
  for (std::size_t i = first; i-- > 0;) {
    std::string_view text = lines[i].text;
    if (!head.rate) head.rate = rate_in(text);
    text = trimmed(text.substr(std::min(text.find_first_not_of("#%/ "), text.size())));
    if (text.empty()) continue;
    Texts fields = layout.cut(text);
    if (fields.size() == layout.fields && above.size() < 2) above.push_back(std::move(fields));
    else if (above.empty()) break;
  }
  const bool has_units = above.size() == 2 && std::all_of(above[0].begin(), above[0].end(), is_unit);
  for (std::size_t i = 0; i < layout.fields; ++i) {
    RecordColumn column{fmt::format("{}", i + 1), ""};
    if (!above.empty()) std::tie(column.name, column.unit) = name_and_unit(above[has_units ? 1 : 0][i]);
    if (has_units) column.unit = bare(above[0][i]);
    head.columns.push_back(column);
  }
  return head;
}

class Reader {
 public:
  explicit Reader(const RecordRequest& request) : request_(request), text_(NumericTable::text_of(request.path)) {}

  AccelerationRecord read() {
    lines_ = lines_of(text_);
    find_rows();
    head_ = head_of(lines_, first_, layout_);
    read_rows();
    record_.path = request_.path;
    choose_time();
    choose_axes();
    take_times();
    take_values();
    return std::move(record_);
  }

 private:
  [[noreturn]] void refuse(const std::string& words) const { throw BadInput(request_.path + ": " + words); }

  void find_rows() {
    for (const bool with_texts : {false, true}) {
      for (first_ = 0; first_ < lines_.size(); ++first_) {
        if (is_comment(lines_[first_].text)) continue;
        if (const auto layout = layout_at(lines_, first_, with_texts)) {
          layout_ = *layout;
          return;
        }
      }
    }
    refuse("no rows of numbers: a row for each instant is needed, with one to three accelerations");
  }

  void read_rows() {
    for (std::size_t i = first_; i < lines_.size(); ++i) {
      if (is_comment(lines_[i].text)) continue;
      const Texts texts = layout_.cut(lines_[i].text);
      const std::size_t line = lines_[i].number;
      if (texts.size() != layout_.fields)
        throw BadInput(fmt::format("{}:{}:1: {} fields: must be {} as in the rows above", request_.path, line,
                                   texts.size(), layout_.fields));
      for (const std::string& text : texts) {
        double value = 0;
        numbers_.push_back(layout_.read(text, value) ? value : std::nan(""));
      }
      row_lines_.push_back(line);
    }
    if (count() < least_rows) refuse(fmt::format("{} rows: at least {} are needed", count(), least_rows));
  }

  [[nodiscard]] std::size_t count() const { return row_lines_.size(); }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return numbers_[row * layout_.fields + column]; }
  /// @throws BadInput for a field that is no number.
  [[nodiscard]] double number(std::size_t row, std::size_t column) const {
    const double value = at(row, column);
    if (std::isfinite(value)) return value;
    const std::string text = layout_.cut(lines_[row_lines_[row] - 1].text)[column];
    throw BadInput(fmt::format("{}:{}:1: column {} = {}: must be a finite number", request_.path, row_lines_[row],
                               head_.columns[column].name, shown_field(text)));
  }

  [[nodiscard]] bool rises(std::size_t column) const {
    for (std::size_t i = 1; i < count(); ++i) {
      if (!(at(i, column) > at(i - 1, column))) return false;
    }
    return true;
  }

  void choose_time() {
    const bool is_named = std::any_of(head_.columns.begin(), head_.columns.end(),
                                      [](const RecordColumn& c) { return !std::isdigit(c.name.front()); });
    for (std::size_t k = 0; k < head_.columns.size() && !time_; ++k) {
      if (is_time(head_.columns[k])) time_ = k;
    }
    if (!is_named && layout_.fields > 1 && !request_.rate && rises(0)) time_ = 0;
    if (request_.rate) time_.reset();  // what was asked for, in place of a clock that is not wanted
  }

  [[nodiscard]] std::string names() const {
    Texts all;
    for (const RecordColumn& column : head_.columns) all.push_back(column.name);
    return fmt::format("{}", fmt::join(all, ", "));
  }

  void choose_axes() {
    for (const std::string& wanted : request_.columns) {
      const auto found = std::find_if(head_.columns.begin(), head_.columns.end(),
                                      [&](const RecordColumn& c) { return lower(c.name) == lower(wanted); });
      if (found == head_.columns.end()) refuse(fmt::format("--column {}: must be of {}", wanted, names()));
      axes_.push_back(static_cast<std::size_t>(found - head_.columns.begin()));
    }
    for (std::size_t k = 0; request_.columns.empty() && k < head_.columns.size(); ++k) {
      const RecordColumn& column = head_.columns[k];
      if (!is_time(column) && time_ != k && !is_by_the_way(column) && std::isfinite(at(0, k))) axes_.push_back(k);
    }
    const auto has_unit = [&](std::size_t k) {
      return factor_of(acceleration_units, head_.columns[k].unit).has_value();
    };
    if (request_.columns.empty() && std::any_of(axes_.begin(), axes_.end(), has_unit))
      std::erase_if(axes_, [&](std::size_t k) { return !has_unit(k); });
    if (axes_.empty() || axes_.size() > 3)
      refuse(fmt::format("{} columns of acceleration: --column must name one to three of {}", axes_.size(), names()));
  }

  void take_times() {
    if (!time_) {
      const std::optional<double> rate = request_.rate ? request_.rate : head_.rate;
      if (!rate) refuse(fmt::format("no column of time among {}: --rate HZ says how often was sampled", names()));
      for (std::size_t i = 0; i < count(); ++i) record_.times.push_back(static_cast<double>(i) / *rate);
      record_.remarks.push_back(
          fmt::format("sampled at {} Hz{}", shortest(*rate), request_.rate ? "" : ", as the lines above the rows say"));
      return;
    }
    const RecordColumn& column = head_.columns[*time_];
    const std::optional<double> factor = factor_of(time_units, column.unit);
    if (!factor && !column.unit.empty())
      refuse(fmt::format("column {}: unit {}: must be s, ms, us or ns", column.name, column.unit));
    for (std::size_t i = 0; i < count(); ++i) {
      if (i > 0 && !(number(i, *time_) > number(i - 1, *time_)))
        throw BadInput(fmt::format("{}:{}:1: column {} = {}: must be later than in the row before", request_.path,
                                   row_lines_[i], column.name, shortest(at(i, *time_))));
      record_.times.push_back((number(i, *time_) - number(0, *time_)) * factor.value_or(1));
    }
    record_.remarks.push_back(
        fmt::format("time: column {}{}", column.name, factor ? " in " + column.unit : ", taken as seconds"));
  }

  void take_values() {
    std::array<double, 3> factors{};
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const RecordColumn& column = head_.columns[axes_[a]];
      const std::optional<double> stated = factor_of(acceleration_units, column.unit);
      if (!stated && !request_.unit)
        refuse(fmt::format("column {}: its unit is not stated: --unit g or --unit m/s2 says it", column.name));
      factors[a] = request_.unit ? (*request_.unit == AccelerationUnit::g ? g : 1) : *stated;
      record_.axes.push_back(column.name);
    }
    for (std::size_t i = 0; i < count(); ++i) {
      Vector3& value = record_.values.emplace_back(Vector3::Zero());
      for (std::size_t a = 0; a < axes_.size(); ++a) value[static_cast<int>(a)] = number(i, axes_[a]) * factors[a];
    }
    const std::string& unit = head_.columns[axes_[0]].unit;
    record_.remarks.push_back(fmt::format(
        "acceleration: {} in {}", fmt::join(record_.axes, ", "),
        request_.unit ? (*request_.unit == AccelerationUnit::g ? "g, as --unit says" : "m/s², as --unit says") : unit));
  }

  const RecordRequest& request_;
  std::string text_;
  std::vector<TextLine> lines_;
  Layout layout_;
  std::size_t first_ = 0;
  Head head_;
  std::vector<double> numbers_;  ///< of all rows
  std::vector<std::size_t> row_lines_;
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
