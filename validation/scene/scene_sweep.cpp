// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/scene_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

constexpr int most_values = 1'000'000;
constexpr std::array<const char*, 5> range_parts{".from", ".to", ".step", ".count", ".scale"};
const char* const forms = "a sweep is a list, or has from, to and step or count";
const std::vector<std::string> scales{"linear", "log"};

SceneSweep read_list(const SceneValues& values, const std::string& key, const Range& range) {
  SceneSweep sweep;
  sweep.listed = values.number_list(key, range);
  const auto [least, largest] = std::minmax_element(sweep.listed.begin(), sweep.listed.end());
  sweep.from = *least;
  sweep.to = *largest;
  return sweep;
}

void read_count(const SceneValues& values, const std::string& table, SceneSweep& sweep) {
  values.exclude(table + ".count", table + ".step");
  sweep.count = values.integer(table + ".count", 0, 2, most_values);
  sweep.logarithmic = values.name(table + ".scale", 0, scales) == 1;
  if (sweep.logarithmic && !(sweep.from > 0)) values.refuse(table + ".from", "greater than 0 with scale = \"log\"");
}

SceneSweep read_grid(const SceneValues& values, const std::string& table, const Range& range) {
  for (const char* key : {".from", ".to"}) values.require(table + key, forms);
  SceneSweep sweep;
  sweep.from = values.number(table + ".from", 0, range);
  sweep.to = values.number(table + ".to", 0, range);
  if (!(sweep.to >= sweep.from)) values.refuse(table + ".to", "at least the sweep's from");
  if (values.has(table + ".count")) {
    read_count(values, table, sweep);
    return sweep;
  }
  values.require(table + ".step", forms);
  if (values.has(table + ".scale")) values.refuse(table + ".scale", "left out with step; give count");
  sweep.step = values.number(table + ".step", 1, positive_number);
  if (!((sweep.to - sweep.from) / sweep.step <= most_values)) {
    values.refuse(table + ".step", fmt::format("at most {} values", most_values));
  }
  return sweep;
}

/// Value i of `count` from one end to the other.
double placed(const SceneSweep& sweep, long long i) {
  if (i == sweep.count - 1) return sweep.to;
  if (sweep.logarithmic) return clean_ratio(sweep.from, sweep.to, i, sweep.count);
  return clean_step(sweep.from, (sweep.to - sweep.from) / static_cast<double>(sweep.count - 1), i);
}

}  // namespace

std::vector<double> SceneSweep::values() const {
  if (!listed.empty()) return listed;
  std::vector<double> values;
  for (long long i = 0; i < count; ++i) values.push_back(placed(*this, i));
  if (count > 0) return values;
  const long long steps = count_of_steps((to - from) / step);
  for (long long i = 0; i < steps; ++i) values.push_back(std::min(clean_step(from, step, i), to));
  return values;
}

const std::string& SceneSweep::name() const { return sweep_names()[static_cast<std::size_t>(quantity)]; }

Value SceneSweep::fields() const {
  if (!listed.empty()) return listed;
  Value fields = Value::Fields{{"from", from}, {"to", to}};
  if (count > 0) fields["count"] = count;
  else fields["step"] = step;
  if (logarithmic) fields["scale"] = "log";
  return fields;
}

std::optional<SceneSweep> read_sweep_table(const SceneValues& values) {
  std::optional<SceneSweep> sweep;
  for (std::size_t i = 0; i < sweep_names().size(); ++i) {
    const std::string table = "sweep." + sweep_names()[i];
    if (!values.has(table) && !values.has_table(table)) continue;
    if (sweep) throw BadInput(fmt::format("{}: {}: only one quantity can be swept", values.path(), table));
    const Key& key = key_named(i == 0 ? "drop.angle_deg" : "ground.sliding_friction");
    const Range& range = std::get<NumberValue>(key.value).range;
    sweep = values.has(table) ? read_list(values, table, range) : read_grid(values, table, range);
    sweep->quantity = static_cast<SceneSweep::Quantity>(i);
  }
  return sweep;
}

void drop_sweep(SceneValues& values, const std::string& name) {
  values.drop("sweep." + name);
  for (const char* part : range_parts) values.drop("sweep." + name + part);
}

}  // namespace clatter::validation
