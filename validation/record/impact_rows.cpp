// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/record/impact_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <sstream>
#include <string_view>

#include "validation/output/estimated.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation::inline record {
namespace {

using analytic::ImpactRow;
using analytic::Tail;

Value to_value(const Entry& entry) {
  return std::visit(
      [](const auto& content) -> Value {
        using Content = std::decay_t<decltype(content)>;
        constexpr bool is_list = std::is_same_v<Content, EntryVector> || std::is_same_v<Content, EntryParameters>;
        if constexpr (is_list) return nullptr;
        else return content;
      },
      entry);
}

/// The parts of a vector or of Euler parameters; empty: the entry is neither.
std::span<const double> list_of(const Entry& entry) {
  if (const auto* vector = std::get_if<EntryVector>(&entry)) return *vector;
  if (const auto* parameters = std::get_if<EntryParameters>(&entry)) return *parameters;
  return {};
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Rows to ask for the kinds of quantities.
const ImpactRow some_row{};
const analytic::space::ImpactRow some_flown{};
const numeric::ImpactRecord some_record{};
DiscreteRow some_impact(const DiscreteRow*) { return {some_row}; }
SpaceRow some_impact(const SpaceRow*) { return {some_flown}; }
ContinuousRow some_impact(const ContinuousRow*) { return {some_record}; }

/// Columns that an entry of this kind takes.
std::size_t width_of(const Entry& entry) { return std::max<std::size_t>(list_of(entry).size(), 1); }

constexpr const char* axes[] = {"x", "y", "z"};
constexpr const char* parameters[] = {"q0", "q1", "q2", "q3"};

void add_columns(const ImpactQuantity& quantity, const Entry& kind, const std::vector<std::string>& shown,
                 std::vector<Column>& columns) {
  if (list_of(kind).empty()) {
    columns.push_back({.name = quantity.name,
                       .heading = quantity.symbol,
                       .unit = quantity.unit,
                       .meaning = quantity.meaning,
                       .shown = contains(shown, quantity.name)});
    return;
  }
  std::istringstream symbols(quantity.symbol);
  const bool is_vector = width_of(kind) == 3;
  for (const char* const part :
       is_vector ? std::span<const char* const>(axes) : std::span<const char* const>(parameters)) {
    std::string symbol;
    symbols >> symbol;
    const std::string name = fmt::format("{}_{}", quantity.name, part);
    columns.push_back({.name = name,
                       .heading = symbol,
                       .unit = quantity.unit,
                       .meaning = fmt::format("{}: {}", part, quantity.meaning),
                       .shown = contains(shown, name),
                       .key = quantity.name,
                       .listed = true});
  }
}

/// The part of an entry as a number; NaN: none.
double part_of(const Entry& entry, std::size_t part) {
  if (const auto list = list_of(entry); !list.empty()) return list[part];
  const auto* number = std::get_if<double>(&entry);
  return number ? *number : std::numeric_limits<double>::quiet_NaN();
}

/// Cells of a value, three of a vector.
void add_cells(const ImpactQuantity& quantity, const Entry& value, const Entry& error, const ImpactDigits& digits,
               Row& row) {
  if (list_of(value).empty() && !std::holds_alternative<double>(value)) {
    row.emplace_back(to_value(value));
    return;
  }
  for (std::size_t part = 0; part < width_of(value); ++part) {
    row.push_back(digits.cell(part_of(value, part), part_of(error, part), quantity.scale));
  }
}

void add_errors(const Entry& error, Row& row) {
  for (std::size_t part = 0; part < width_of(error); ++part) row.emplace_back(Value(part_of(error, part)));
}

/// Calls use(quantity, value, error) for each quantity of the impact; the error is unknown where there is none.
template <class Impact, class Use>
void for_each_quantity(const Impact& impact, Use&& use) {
  for (const ImpactQuantity& quantity : impact_quantities()) {
    const Getter<Impact>& get = quantity.of<Impact>();
    if (get.value) use(quantity, get.value(impact), get.error ? get.error(impact) : Entry(unknown_error));
  }
}

template <class Impact, class Use>
void for_each_value(const Impact& impact, Use&& use) {
  for (const ImpactQuantity& quantity : impact_quantities()) {
    const Getter<Impact>& get = quantity.of<Impact>();
    if (get.value) use(quantity, get.value(impact));
  }
}

template <class Impact, class Use>
void for_each_error(const Impact& impact, Use&& use) {
  for (const ImpactQuantity& quantity : impact_quantities()) {
    const Getter<Impact>& get = quantity.of<Impact>();
    if (get.error) use(quantity, get.error(impact));
  }
}

/// The entries of the tail in the places of an impact's.
template <class AnyTail>
Entry tail_entry(const Entry& kind, Entry (*get)(const AnyTail&), const AnyTail& tail) {
  if (get) return get(tail);
  switch (width_of(kind)) {
    case 3: return EntryVector{unknown_error, unknown_error, unknown_error};
    case 4: return EntryParameters{unknown_error, unknown_error, unknown_error, unknown_error};
    default: return nullptr;
  }
}

void append_part(std::string& out, double number) {
  out += ',';
  append_number(out, number);
}

void append_entry(std::string& out, const Entry& entry) {
  for (const double part : list_of(entry)) append_part(out, part);
  if (!list_of(entry).empty()) return;
  out += ',';
  if (const auto* number = std::get_if<double>(&entry)) append_number(out, *number);
  else if (const auto* text = std::get_if<std::string>(&entry)) out += *text;
  else if (const auto* whole = std::get_if<int>(&entry)) out += std::to_string(*whole);
  else if (const auto* truth = std::get_if<bool>(&entry)) out += *truth ? "true" : "false";
}

/// Nothing in the places of an entry.
void append_nothing(std::string& out, const Entry& kind) { out.append(width_of(kind), ','); }

}  // namespace

Cell ImpactDigits::cell(double value, double error, Scale scale) const {
  constexpr int without_estimate = 2;  // a tolerance of 1e-4 and less leaves them
  if (!trusted) return {value, 0};
  if (!estimated) return {value, without_estimate};
  return known_cell({value, error}, {digits, scales[static_cast<std::size_t>(scale)]});
}

template <class Impact>
std::vector<Column> impact_columns(const std::vector<std::string>& shown) {
  std::vector<Column> columns;
  const Impact impact = some_impact(static_cast<const Impact*>(nullptr));
  for_each_quantity(impact, [&](const ImpactQuantity& quantity, const Entry& kind, const Entry&) {
    add_columns(quantity, kind, shown, columns);
  });
  const std::size_t values = columns.size();
  for_each_error(impact,
                 [&](const ImpactQuantity& quantity, const Entry& kind) { add_columns(quantity, kind, {}, columns); });
  for (std::size_t i = values; i < columns.size(); ++i) columns[i] = error_column(columns[i]);
  return columns;
}

template <class Impact>
Row impact_row(const Impact& impact, const ImpactDigits& digits) {
  Row row;
  for_each_quantity(impact, [&](const ImpactQuantity& quantity, const Entry& value, const Entry& error) {
    add_cells(quantity, value, error, digits, row);
  });
  for_each_error(impact, [&](const ImpactQuantity&, const Entry& error) { add_errors(error, row); });
  return row;
}

Row tail_row(const Tail& tail, const ImpactDigits& digits) {
  Row row;
  const DiscreteRow impact = some_impact(static_cast<const DiscreteRow*>(nullptr));
  for_each_quantity(impact, [&](const ImpactQuantity& quantity, const Entry& kind, const Entry&) {
    const Entry value = tail_entry(kind, quantity.tail.value, tail);
    if (quantity.tail.value) add_cells(quantity, value, tail_entry(kind, quantity.tail.error, tail), digits, row);
    else row.resize(row.size() + width_of(kind));
  });
  for_each_error(impact, [&](const ImpactQuantity& quantity, const Entry& kind) {
    if (quantity.tail.error) add_errors(quantity.tail.error(tail), row);
    else row.resize(row.size() + width_of(kind));
  });
  return row;
}

template <class Columns, class Impact>
void append_impact(std::string& out, const Impact& impact, bool with_errors) {
  const Columns columns = some_impact(static_cast<const Columns*>(nullptr));
  for_each_value(columns, [&](const ImpactQuantity& quantity, const Entry& kind) {
    const auto value = quantity.of<Impact>().value;
    if (value && (with_errors || quantity.name != std::string_view("predictable"))) append_entry(out, value(impact));
    else append_nothing(out, kind);
  });
  for_each_error(columns, [&](const ImpactQuantity& quantity, const Entry& kind) {
    const auto error = quantity.of<Impact>().error;
    if (error && with_errors) append_entry(out, error(impact));
    else append_nothing(out, kind);
  });
}

template <class Columns, class AnyTail>
void append_tail(std::string& out, const AnyTail& tail, bool with_errors) {
  const Columns columns = some_impact(static_cast<const Columns*>(nullptr));
  for_each_value(columns, [&](const ImpactQuantity& quantity, const Entry& kind) {
    append_entry(out, tail_entry(kind, quantity.of<AnyTail>().value, tail));
  });
  for_each_error(columns, [&](const ImpactQuantity& quantity, const Entry& kind) {
    append_entry(out, tail_entry(kind, with_errors ? quantity.of<AnyTail>().error : nullptr, tail));
  });
}

template std::vector<Column> impact_columns<DiscreteRow>(const std::vector<std::string>&);
template std::vector<Column> impact_columns<SpaceRow>(const std::vector<std::string>&);
template std::vector<Column> impact_columns<ContinuousRow>(const std::vector<std::string>&);
template Row impact_row(const DiscreteRow&, const ImpactDigits&);
template Row impact_row(const SpaceRow&, const ImpactDigits&);
template Row impact_row(const ContinuousRow&, const ImpactDigits&);
template void append_impact<DiscreteRow>(std::string&, const DiscreteRow&, bool);
template void append_impact<SpaceRow>(std::string&, const DiscreteRow&, bool);
template void append_impact<SpaceRow>(std::string&, const SpaceRow&, bool);
template void append_impact<ContinuousRow>(std::string&, const ContinuousRow&, bool);
template void append_tail<DiscreteRow>(std::string&, const analytic::Tail&, bool);
template void append_tail<SpaceRow>(std::string&, const analytic::Tail&, bool);
template void append_tail<SpaceRow>(std::string&, const analytic::space::Tail&, bool);

}  // namespace clatter::validation::inline record
