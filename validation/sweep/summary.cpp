// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <stdexcept>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

/// The sign, the exponent and the first twelve bits of the fraction, in the order of the numbers.
long long bin_of(double number) {
  constexpr int dropped_bits = 40;
  const auto bits = std::bit_cast<std::int64_t>(std::fabs(number)) >> dropped_bits;
  return number < 0 ? -1 - bits : bits;
}

std::string percent_name(double percent) { return fmt::format("p{:g}", percent); }

/// "-z 33.1 % (32.0 to 34.2)", a share of all rows with the interval that holds its probability; adds it to `shares`.
std::string share_words(const std::string& text, long long count, long long rows, bool is_first, Value::List& shares) {
  const Wilson interval(count, rows);
  shares.emplace_back(Value::Fields{
      {"text", text}, {"count", count}, {"share", interval.part}, {"low", interval.low}, {"high", interval.high}});
  return fmt::format("{}{} {} % ({} to {})", is_first ? "" : ", ", text, significant(100 * interval.part, 3),
                     significant(100 * interval.low, 3), significant(100 * interval.high, 3));
}

/// The columns of a layout that were asked for by name, by a probe or a part, or as those of rest.
std::vector<std::string> asked_names(const RowLayout& layout, const std::string& ranked_by) {
  std::vector<std::string> names{ranked_by};
  for (const Probe& probe : layout.probes) {
    for (const std::string_view column : {margin_column, peak_column, std::string_view("width_"), shock_column})
      names.push_back(std::string(column) + probe.name);
  }
  for (const ImpactColumn& asked : layout.asked) names.push_back(asked.column.name);
  names.insert(names.end(), layout.named.begin(), layout.named.end());
  if (layout.rests) names.emplace_back("rest_time");
  return names;
}

/// "6 in 120, 5 in 60 and 3 others", the most frequent first.
template <class Counts>
std::string tally_words(const Counts& counts) {
  constexpr std::size_t most_named = 4;
  std::vector<std::pair<std::string, long long>> order;
  for (const auto& [what, count] : counts) order.emplace_back(fmt::format("{}", what), count);
  std::ranges::stable_sort(order, std::ranges::greater{}, &std::pair<std::string, long long>::second);
  std::string words;
  for (std::size_t i = 0; i < std::min(order.size(), most_named); ++i)
    words += fmt::format("{}{} in {}", i == 0 ? "" : ", ", order[i].first, order[i].second);
  return words + (order.size() > most_named ? fmt::format(" and {} others", order.size() - most_named) : "");
}

constexpr std::size_t few = 64;  // values of a column that are counted each

bool is_summarised(const Column& column) { return !column.words && !column.name.ends_with("_error"); }

}  // namespace

void Histogram::add(double number) {
  Bin& bin = bins_[bin_of(number)];
  bin.least = bin.count == 0 ? number : std::min(bin.least, number);
  bin.largest = bin.count == 0 ? number : std::max(bin.largest, number);
  ++bin.count;
  ++count_;
}

Estimated Histogram::percentile(double part) const {
  if (count_ == 0) throw std::invalid_argument("Histogram::percentile: no numbers");
  const std::map<long long, Bin> ordered(bins_.begin(), bins_.end());
  const auto rank = std::clamp(static_cast<long long>(std::ceil(part * static_cast<double>(count_))), 1LL, count_);
  long long before = 0;
  auto bin = ordered.begin();
  while (before + bin->second.count < rank) before += (bin++)->second.count;
  const double middle = bin->second.least / 2 + bin->second.largest / 2;
  return {middle, std::max(middle - bin->second.least, bin->second.largest - middle)};
}

Wilson::Wilson(long long hits, long long samples) {
  constexpr double z = 1.959963984540054;
  const double n = static_cast<double>(samples);
  part = static_cast<double>(hits) / n;
  const double middle = part + z * z / (2 * n), spread = z * std::sqrt(part * (1 - part) / n + z * z / (4 * n * n));
  low = hits == 0 ? 0 : (middle - spread) / (1 + z * z / n);
  high = hits == samples ? 1 : (middle + spread) / (1 + z * z / n);
}

Summary::Summary(const RowLayout& layout, const SweepPoints& points)
    : columns_(sweep_columns(layout)), first_(1 + layout.swept.size()),
      rank_by_(!layout.rank_by.empty() ? layout.rank_by
               : layout.probes.empty() ? ""
                                       : ranking_column(layout, layout.first_ranked())),
      points_(&points),
      outcome_(static_cast<std::size_t>(std::ranges::find(columns_, "outcome", &Column::name) - columns_.begin())),
      numbers_(columns_.size()),
      worst_(static_cast<std::size_t>(points.attitudes()), std::vector<Extreme>(columns_.size(), {0, -1})),
      texts_(columns_.size()), row_(columns_.size()) {
  const auto by = ranking();
  if (!layout.rank_by.empty() && worst_.empty()) ranked_ = by;
  const bool ranks = by && (!worst_.empty() || !rank_by_.empty());
  for (const std::string& name : asked_names(layout, ranks ? columns_[*by].name : "")) {
    const auto column = std::ranges::find(columns_, name, &Column::name);
    const auto place = static_cast<std::size_t>(column - columns_.begin());
    if (column != columns_.end() && std::ranges::find(asked_, place) == asked_.end()) asked_.push_back(place);
  }
}

void Summary::add(std::string_view rows) {
  for (PackedRows packed(rows); packed.next(row_);) {
    const auto index = static_cast<long long>(row_.front().number);
    for (std::size_t i = first_; i < row_.size(); ++i) {
      const PackedCell& cell = row_[i];
      if (cell.is_text) ++texts_[i][std::string(cell.text)];
      if (cell.is_truth) ++texts_[i][cell.number != 0 ? "true" : "false"];
      if (!std::isfinite(cell.number) || !is_summarised(columns_[i])) continue;
      Numbers& numbers = numbers_[i];
      const bool first = numbers.histogram.count() == 0;
      if (first || cell.number < numbers.least.value) numbers.least = {cell.number, index};
      if (first || cell.number > numbers.largest.value) numbers.largest = {cell.number, index};
      numbers.histogram.add(cell.number);
      if (columns_[i].unit.empty() && numbers.tally.size() <= few) ++numbers.tally[cell.number];
      if (i == ranked_) rank({cell.number, index}, i);
      if (worst_.empty()) continue;
      Extreme& of_attitude = worst_[static_cast<std::size_t>(points_->attitude_of(index))][i];
      if (of_attitude.index < 0 || is_worse(i, cell.number, of_attitude.value)) of_attitude = {cell.number, index};
    }
  }
}

std::vector<Column> Summary::columns() {
  std::vector<Column> columns{word_column("quantity", "quantity", "column of the sweep's rows"),
                              word_column("unit", "unit", "its unit"),
                              {"count", "count", "", "rows that have it"},
                              {"least", "least", "", "least value"}};
  std::vector<Column> errors;
  for (const double percent : summary_percents) {
    const bool shown = percent == 5 || percent == 50 || percent == 95;
    columns.push_back({percent_name(percent), fmt::format("{:g} %", percent), "",
                       fmt::format("value that {:g} % of them do not exceed", percent), shown});
    errors.push_back(error_column(columns.back()));
  }
  columns.push_back({"largest", "largest", "", "largest value"});
  columns.push_back({"least_index", "least at", "", "scene that has the least value", false});
  columns.push_back({"largest_index", "largest at", "", "scene that has the largest value", false});
  columns.insert(columns.end(), errors.begin(), errors.end());
  for (const char* extreme : {"least", "largest"}) {
    Column command = word_column(fmt::format("{}_command", extreme), "command",
                                 fmt::format("command that shows the scene with the {} value", extreme));
    command.shown = false;
    columns.push_back(command);
  }
  return columns;
}

void Summary::add_number(Report& report, std::size_t column, const std::string& least,
                         const std::string& largest) const {
  const Numbers& numbers = numbers_[column];
  const auto is_whole = [](const auto& counted) { return counted.first == std::rint(counted.first); };
  const bool counts = !numbers.tally.empty() && std::ranges::all_of(numbers.tally, is_whole);
  for (const auto& [value, count] : numbers.tally) {
    if (counts && numbers.tally.size() <= few) report.fields["counts"][columns_[column].name][shortest(value)] = count;
  }
  const auto shown = [&](const Estimated& value) {
    return counts && value.error == 0 ? Cell(std::llrint(value.value)) : known_cell(value, {});
  };
  Row row{Cell(columns_[column].name), Cell(columns_[column].unit), Cell(numbers.histogram.count()),
          shown({numbers.least.value, 0})};
  Row errors;
  for (const double percent : summary_percents) {
    const Estimated value = numbers.histogram.percentile(percent / 100);
    row.push_back(shown(value));
    errors.emplace_back(rounded_up(value.error));
  }
  row.insert(row.end(), {shown({numbers.largest.value, 0}), Cell(numbers.least.index), Cell(numbers.largest.index)});
  row.insert(row.end(), errors.begin(), errors.end());
  row.insert(row.end(), {Cell(least), Cell(largest)});
  report.grid.rows.push_back(std::move(row));
}

const char* Summary::end_of(std::size_t column) const {
  return is_worst_least(columns_[column].name) ? "least" : "largest";
}

bool Summary::is_worse(std::size_t column, double one, double other) const {
  return is_worst_least(columns_[column].name) ? one < other : one > other;
}

std::optional<std::size_t> Summary::ranking() const {
  // By which blows are hard: for the first of the probes, if there are any.
  for (const std::string& wanted : {rank_by_, std::string("largest_peak_force"), std::string("hardest_impulse_normal"),
                                    std::string("total_normal_impulse")}) {
    const auto column = std::ranges::find(columns_, wanted, &Column::name);
    if (column != columns_.end()) return static_cast<std::size_t>(column - columns_.begin());
  }
  return {};
}

void Summary::add_attitudes(Report& report, const std::function<std::string(long long)>& name) const {
  const std::optional<std::size_t> found = ranking();
  if (!found) return;
  const std::size_t by = *found;
  std::vector<std::size_t> order(worst_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Extreme &one = worst_[a][by], &other = worst_[b][by];
    return one.index >= 0 && (other.index < 0 || is_worse(by, one.value, other.value));
  });
  constexpr std::size_t most_named = 5;
  const auto drops = numbers_[by].histogram.count() / static_cast<long long>(worst_.size());
  std::string words =
      fmt::format("attitudes by {}{}:", columns_[by].name,
                  drops > 1 ? fmt::format(", the {} of about {} drops of each", end_of(by), drops) : "");
  Value::List list;
  for (std::size_t place = 0; place < order.size(); ++place) {
    const std::vector<Extreme>& worst = worst_[order[place]];
    const std::string its_name = name(static_cast<long long>(order[place]));
    if (place < most_named && worst[by].index >= 0) {
      words += fmt::format("{} {}: {} {}", place == 0 ? "" : ";", its_name, significant(worst[by].value, 4),
                           columns_[by].unit);
      if (columns_[by].unit.empty()) words.pop_back();
    }
    Value::Fields fields{{"attitude", its_name}};
    for (std::size_t i = first_; i < columns_.size(); ++i) {
      if (worst[i].index < 0) continue;
      fields.push_back({columns_[i].name, Value::Fields{{end_of(i), worst[i].value}, {"index", worst[i].index}}});
    }
    list.emplace_back(std::move(fields));
  }
  report.fields["attitudes"] = list;
  report.notes.push_back(words);
}

void Summary::rank(const Extreme& scene, std::size_t column) {
  constexpr std::size_t most = 10;
  const auto is_before = [&](const Extreme& one, const Extreme& other) {
    return is_worse(column, one.value, other.value) || (one.value == other.value && one.index < other.index);
  };
  if (worst_scenes_.size() == most && !is_before(scene, worst_scenes_.back())) return;
  const auto same = std::ranges::find(worst_scenes_, scene.index, &Extreme::index);
  if (same == worst_scenes_.end()) worst_scenes_.push_back(scene);
  else if (is_before(scene, *same)) *same = scene;
  std::ranges::sort(worst_scenes_, is_before);
  if (worst_scenes_.size() > most) worst_scenes_.pop_back();
}

Grid Summary::worst_scenes() const {
  Grid grid{{columns_.front(), columns_[*ranked_]}, {}};
  grid.columns.insert(grid.columns.end(), columns_.begin() + 1, columns_.begin() + static_cast<std::ptrdiff_t>(first_));
  grid.columns.push_back(word_column("command", "command", "command that shows the scene"));
  grid.columns.back().shown = false;
  std::vector<double> values;
  for (const Extreme& scene : worst_scenes_) {
    points_->at(scene.index, values);
    grid.rows.push_back({Cell(scene.index), known_cell({scene.value, 0}, {})});
    for (const double value : values) grid.rows.back().push_back(known_cell({value, 0}, {}));
  }
  return grid;
}

void Summary::add_texts(Report& report) const {
  const long long rows = std::accumulate(texts_[outcome_].begin(), texts_[outcome_].end(), 0LL,
                                         [](long long sum, const auto& text) { return sum + text.second; });
  report.fields["texts"] = Value(Value::Fields{});
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    if (texts_[i].empty() && columns_[i].name != "rest_face") continue;
    Value counts(Value::Fields{});
    Value::List shares;
    std::string words;
    const bool has_shares = columns_[i].name == "rest_face" || is_flag(i);
    long long others = rows;
    const auto add_share = [&](const std::string& text, long long count) {
      if (has_shares && count > 0) words += share_words(text, count, rows, words.empty(), shares);
    };
    for (const auto& [text, count] : std::map<std::string, long long>(texts_[i].begin(), texts_[i].end())) {
      counts[text] = count;
      others -= count;
      add_share(text, count);
    }
    add_share("none", others);
    report.fields["texts"][columns_[i].name] = counts;
    if (has_shares) report.fields["shares"][columns_[i].name] = shares;
    const bool is_asked = std::ranges::find(asked_, i) != asked_.end();
    if (!has_shares && is_asked) words = tally_words(texts_[i]);
    if (is_asked || columns_[i].name.starts_with("rest_"))
      report.notes.push_back(fmt::format("{}: {}", columns_[i].name, words));
  }
}

Summary::Tail Summary::longest_tail() const {
  Tail longest;
  const std::optional<std::size_t> ranked = ranking();
  for (std::size_t i = first_; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    const bool counts = numbers_[i].histogram.count() > 0 && !column.unit.empty() && column.unit != "s";
    if (!counts || i == ranked || column.name.starts_with(of_landing)) continue;
    const double times = numbers_[i].largest.value / numbers_[i].histogram.percentile(0.5).value;
    if (std::isfinite(times) && times > longest.times) longest = {i, times};
  }
  return longest;
}

std::vector<std::size_t> Summary::remarked(Report& report) const {
  if (!asked_.empty()) {
    report.digest = Grid{report.grid.columns, {}, report.grid.leading};
    for (const std::size_t column : asked_) {
      const auto is_its = [&](const Row& row) { return shown_text(row.front()) == columns_[column].name; };
      std::ranges::copy_if(report.grid.rows, std::back_inserter(report.digest->rows), is_its);
    }
    if (report.digest->rows.empty()) report.digest.reset();
  }
  std::string outcome = fmt::format("outcome: {}", tally_words(texts_[outcome_])), counts;
  for (std::size_t i = first_; i < columns_.size(); ++i) {
    const std::map<double, long long>& tally = numbers_[i].tally;
    if (columns_[i].name == "predictable" && tally.contains(0))
      outcome += fmt::format("; {} cannot be predicted", tally.at(0));
    if (tally.size() > 1 && (columns_[i].name == "impacts" || columns_[i].name == "hardest"))
      counts += fmt::format("{}{}: {}", counts.empty() ? "" : "; ", columns_[i].name, tally_words(tally));
  }
  report.notes.push_back(outcome);
  const auto warning =
      static_cast<std::size_t>(std::ranges::find(columns_, "warning", &Column::name) - columns_.begin());
  if (warning < columns_.size() && !texts_[warning].empty()) {
    const long long warned = std::accumulate(texts_[warning].begin(), texts_[warning].end(), 0LL,
                                             [](long long sum, const auto& text) { return sum + text.second; });
    report.notes.push_back(
        fmt::format("warning: {} rows, as {}", warned, std::ranges::min_element(texts_[warning])->first));
  }
  if (!counts.empty()) report.notes.push_back(counts);
  std::vector<std::size_t> columns;
  if (const auto by = ranking(); by && numbers_[*by].histogram.count() > 0) columns.push_back(*by);
  if (const Tail tail = longest_tail(); tail.times > 1) {
    const Column& column = columns_[tail.column];
    report.notes.push_back(fmt::format("{}: the largest, {} {}, is {} times the median", column.name,
                                       significant(numbers_[tail.column].largest.value, 4), column.unit,
                                       significant(tail.times, 3)));
    columns.push_back(tail.column);
  }
  return columns;
}

}  // namespace clatter::validation
