// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/impact_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "validation/output/estimated.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using Number = Entry (*)(const Numbers&);
using Fact = Entry (*)(const Impact&);

using enum Known;
/// What the models in the plane and in space, the continuous one and the tail know.
using KnownTo = std::array<Known, 4>;
constexpr KnownTo all_models{value_only, value_only, value_only, absent},
    all_with_errors{with_error, with_error, with_error, absent},
    all_and_tail{with_error, with_error, with_error, with_error}, force_of_contact{empty, empty, with_error, absent},
    simulator_with_errors{absent, absent, with_error, absent}, simulator_alone{absent, absent, value_only, absent};

template <auto Member>
constexpr Number number_at = [](const Numbers& numbers) { return Entry(numbers.*Member); };
template <auto Member>
constexpr Fact fact_at = [](const Impact& impact) { return Entry(impact.*Member); };

constexpr ImpactQuantity quantity(const char* name, const char* symbol, const char* unit, const char* meaning,
                                  Scale scale, const KnownTo& known, Number of_numbers) {
  return {name, symbol, unit, meaning, scale, known, of_numbers, nullptr};
}

constexpr ImpactQuantity quantity(const char* name, const char* symbol, const char* unit, const char* meaning,
                                  Scale scale, const KnownTo& known, Fact of_impact) {
  return {name, symbol, unit, meaning, scale, known, nullptr, of_impact};
}

constexpr ImpactQuantity all[]{
    quantity("n", "n", "", "number of the impact, from 1", Scale::none,
             {value_only, value_only, value_only, value_only},
             [](const Impact& i) { return i.is_tail ? Entry(std::string("tail")) : Entry(i.n); }),
    quantity("end", "end", "", "which end of the body strikes, or its vertices", Scale::none,
             {value_only, value_only, value_only, value_only}, fact_at<&Impact::end>),
    quantity("corners", "corner", "", "which corners of the body strike", Scale::none,
             {absent, value_only, value_only, absent},
             [](const Impact& i) { return i.corners.empty() ? Entry(nullptr) : Entry(i.corners); }),
    quantity("place", "x y z", "m",
             "of the vertex that strikes, body frame, from the geometric centre; a mesh: in its file's frame",
             Scale::none, {absent, value_only, absent, absent}, fact_at<&Impact::place>),
    quantity("attitude", "q₀ q₁ q₂ q₃", "", "Euler parameters at touch-down, body to world, scalar first", Scale::none,
             {absent, with_error, value_only, absent}, number_at<&Numbers::attitude>),
    quantity("touches", "touches", "", "separate places that came down during the impact", Scale::none,
             {absent, value_only, value_only, absent}, fact_at<&Impact::touches>),
    quantity("start", "t", "s", "time of touch-down, after that of impact 1", Scale::time, all_and_tail,
             number_at<&Numbers::start>),
    quantity("duration", "contact", "s", "how long anything touches", Scale::time,
             {value_only, value_only, with_error, absent}, number_at<&Numbers::duration>),
    quantity("inclination_deg", "α", "°", "of the body's x axis at touch-down, positive with end a lower", Scale::angle,
             all_with_errors, number_at<&Numbers::inclination_deg>),
    quantity("contact_angle_deg", "angle", "°", "acute angle between body and ground at touch-down", Scale::angle,
             all_with_errors, number_at<&Numbers::contact_angle_deg>),
    quantity("approach_speed", "v", "m/s", "of the contact point, downward", Scale::speed, all_with_errors,
             number_at<&Numbers::approach_speed>),
    quantity("restitution", "e", "", "separation over approach speed that came out", Scale::ratio, all_with_errors,
             number_at<&Numbers::restitution>),
    quantity("impulse_normal", "Pₙ", "N·s", "normal impulse of the ground", Scale::impulse, all_and_tail,
             [](const Numbers& n) { return Entry(n.impulse[2]); }),
    quantity("impulse_tangential", "Pₜ", "N·s", "tangential impulse of the ground, along x", Scale::impulse,
             all_and_tail, [](const Numbers& n) { return Entry(n.impulse[0]); }),
    quantity("impulse_ratio", "Pₜ/Pₙ", "", "tangential over normal impulse", Scale::ratio, all_with_errors,
             number_at<&Numbers::impulse_ratio>),
    quantity("impulse", "Pₜ P_y Pₙ", "N·s", "impulse of the ground, world frame", Scale::impulse, all_and_tail,
             number_at<&Numbers::impulse>),
    quantity("peak_force", "peak Fₙ", "N", "largest normal force; the discrete model has none", Scale::none,
             force_of_contact, number_at<&Numbers::peak_force>),
    quantity("peak_time", "peak t", "s", "when, after touch-down", Scale::time, force_of_contact,
             number_at<&Numbers::peak_time>),
    quantity("indentation", "depth", "m", "greatest depth of a point of the body below the ground", Scale::none,
             simulator_with_errors, number_at<&Numbers::indentation>),
    quantity("velocity_after", "Vₜ V_y Vₙ", "m/s", "of the centre of mass after the impact, world frame", Scale::speed,
             all_and_tail, number_at<&Numbers::velocity_after>),
    quantity("angular_velocity_after", "ω_x Ω ω_z", "rad/s", "after the impact, world frame", Scale::rate, all_and_tail,
             number_at<&Numbers::angular_velocity_after>),
    quantity("energy_before", "", "J", "translational, rotational and potential, before", Scale::energy,
             all_with_errors, number_at<&Numbers::energy_before>),
    quantity("energy_after", "", "J", "the same after the impact", Scale::energy, all_with_errors,
             number_at<&Numbers::energy_after>),
    quantity("energy_loss", "loss", "J", "energy lost in the impact", Scale::energy, all_with_errors,
             number_at<&Numbers::energy_loss>),
    quantity("work_damping", "", "J", "dissipated by the ground's dampers", Scale::energy, simulator_with_errors,
             number_at<&Numbers::work_damping>),
    quantity("work_friction", "", "J", "dissipated by friction", Scale::energy, simulator_with_errors,
             number_at<&Numbers::work_friction>),
    quantity("work_released", "", "J", "elastic energy left in the ground where the clamp let go", Scale::energy,
             simulator_with_errors, number_at<&Numbers::work_released>),
    quantity("mode", "mode", "", "how friction acted", Scale::none, all_models,
             [](const Impact& i) { return Entry(std::string(i.mode)); }),
    quantity("submerged", "", "", "whether the whole body lay below the ground for a time", Scale::none,
             simulator_alone, fact_at<&Impact::submerged>),
    quantity("local_slip", "", "N·s", "what each place's own slip would change in the tangential impulse",
             Scale::impulse, simulator_alone, fact_at<&Impact::local_slip>),
    quantity("energy_stored", "", "J", "left in the ground's springs", Scale::energy, simulator_alone,
             fact_at<&Impact::energy_stored>),
    quantity("ledger_gap", "", "", "by how much the ledger of energy does not close", Scale::none, simulator_alone,
             fact_at<&Impact::ledger_gap>),
    quantity("amplification", "", "", "growth of a relative error of the start until the end of this impact",
             Scale::none, all_models, fact_at<&Impact::amplification>),
    quantity("predictable", "", "", "whether errors have not grown so far that another sequence may follow",
             Scale::none, all_models, fact_at<&Impact::predictable>)};

}  // namespace

Entry ImpactQuantity::kind() const {
  static const Impact some{.corners = "0"};  // the text that an impact without named corners lacks
  return value(some);
}

std::span<const ImpactQuantity> impact_quantities() { return all; }

namespace {

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
  std::string_view symbols(quantity.symbol);
  const bool is_vector = width_of(kind) == 3;
  for (const char* const part :
       is_vector ? std::span<const char* const>(axes) : std::span<const char* const>(parameters)) {
    const std::string_view symbol = symbols.substr(0, symbols.find(' '));
    symbols.remove_prefix(std::min(symbol.size() + 1, symbols.size()));
    const std::string name = fmt::format("{}_{}", quantity.name, part);
    columns.push_back({.name = name,
                       .heading = std::string(symbol),
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
  for (std::size_t part = 0; part < width_of(value); ++part)
    row.push_back(digits.cell(part_of(value, part), part_of(error, part), quantity.scale));
}

void add_errors(const Entry& error, Row& row) {
  for (std::size_t part = 0; part < width_of(error); ++part) row.emplace_back(rounded_up(part_of(error, part)));
}

/// What the model knows of a quantity of the impact; a tail knows less.
Known known_of(const ImpactQuantity& quantity, RunModel model, const Impact& impact) {
  const Known known = quantity.known_to(model);
  return impact.is_tail ? std::min(known, quantity.known.back()) : known;
}

void append_error(CellWriter& out, const Entry& entry) {
  for (std::size_t part = 0; part < width_of(entry); ++part) out.error(part_of(entry, part));
}

void append_entry(CellWriter& out, const Entry& entry) {
  for (const double part : list_of(entry)) out.number(part);
  if (!list_of(entry).empty()) return;
  if (const auto* number = std::get_if<double>(&entry)) out.number(*number);
  else if (const auto* text = std::get_if<std::string>(&entry)) out.word(*text);
  else if (const auto* whole = std::get_if<int>(&entry)) out.whole(*whole);
  else if (const auto* truth = std::get_if<bool>(&entry)) out.truth(*truth);
  else out.nothing();
}

}  // namespace

Cell ImpactDigits::cell(double value, double error, Scale scale) const {
  constexpr int without_estimate = 2;  // a tolerance of 1e-4 and less leaves them
  if (!trusted) return {value, 0};
  if (!estimated) return {value, without_estimate};
  return known_cell({value, error}, {digits, scales[static_cast<std::size_t>(scale)]});
}

Scales scales_of(const Run& run, double reach) {
  Scales scales{};
  const auto grow = [&](Scale scale, double number) {
    double& size = scales[static_cast<std::size_t>(scale)];
    size = std::max(size, std::fabs(number));
  };
  grow(Scale::angle, 90);
  grow(Scale::ratio, 1);
  for (const Impact& impact : run.impacts) {
    grow(Scale::speed, impact.largest_speed);
    grow(Scale::rate, std::max(impact.largest_rate, impact.largest_speed / reach));
    grow(Scale::time, impact.value.start);
    for (const double part : impact.value.impulse) grow(Scale::impulse, part);
    grow(Scale::energy, impact.value.energy_before);
  }
  return scales;
}

std::vector<std::string> shown_quantities(RunModel model) {
  if (model != RunModel::space)
    return {"n", "end", "start", "contact_angle_deg", "impulse_normal", "velocity_after_z", "angular_velocity_after_y"};
  return {"n",
          "corners",
          "start",
          "impulse_normal",
          "velocity_after_z",
          "angular_velocity_after_x",
          "angular_velocity_after_y",
          "angular_velocity_after_z"};
}

std::vector<Column> impact_columns(RunModel model, const std::vector<std::string>& shown) {
  std::vector<Column> columns, errors;
  for (const ImpactQuantity& quantity : impact_quantities()) {
    const Known known = quantity.known_to(model);
    if (known != Known::absent) add_columns(quantity, quantity.kind(), shown, columns);
    if (known == Known::with_error) add_columns(quantity, quantity.kind(), {}, errors);
  }
  for (const Column& column : errors) columns.push_back(error_column(column));
  return columns;
}

Row impact_row(const Impact& impact, RunModel model, const ImpactDigits& digits) {
  Row row, errors;
  for (const ImpactQuantity& quantity : impact_quantities()) {
    const Known column = quantity.known_to(model), known = known_of(quantity, model, impact);
    if (column == Known::absent) continue;
    if (known >= Known::value_only) {
      const Entry unknown(unknown_error), error = known == Known::with_error ? quantity.error(impact) : unknown;
      add_cells(quantity, quantity.value(impact), error, digits, row);
    } else {
      row.resize(row.size() + width_of(quantity.kind()));
    }
    if (column != Known::with_error) continue;
    if (known == Known::with_error) add_errors(quantity.error(impact), errors);
    else errors.resize(errors.size() + width_of(quantity.kind()));
  }
  row.insert(row.end(), errors.begin(), errors.end());
  return row;
}

void append_impact(CellWriter& out, const Impact& impact, const ImpactText& text) {
  for (const ImpactQuantity& quantity : impact_quantities()) {
    if (quantity.known_to(text.columns) == Known::absent) continue;
    const bool is_known = known_of(quantity, text.model, impact) >= Known::value_only;
    const bool is_asked = text.predictions || quantity.name != std::string_view("predictable");
    if (is_known && is_asked) append_entry(out, quantity.value(impact));
    else out.nothing(width_of(quantity.kind()));
  }
  for (const ImpactQuantity& quantity : impact_quantities()) {
    if (quantity.known_to(text.columns) != Known::with_error) continue;
    const bool is_known = known_of(quantity, text.model, impact) == Known::with_error;
    if (is_known && text.errors) append_error(out, quantity.error(impact));
    else out.nothing(width_of(quantity.kind()));
  }
}

}  // namespace clatter::validation
