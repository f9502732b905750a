// SPDX-License-Identifier: GPL-3.0-or-later
// What is done with the rows of keys.cpp, whatever their kind.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "validation/output/report.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

const Range& allowed(const Range& range, const Range* wide, Model model) {
  return wide && model == Model::discrete ? *wide : range;
}

void put_given(const SceneValues& values, const Key& key, Scene& scene, Model model) {
  const bool wide = model == Model::discrete;
  const std::string name = key.name;
  std::visit(
      Overloaded{
          [&](const NumberValue& v) { v.at(scene) = values.number(name, 0, allowed(v.range, v.wide, model)); },
          [&](const OptionalNumber& v) { v.at(scene) = values.number(name, 0, allowed(v.range, v.wide, model)); },
          [&](const WholeNumber& v) {
            v.at(scene) =
                static_cast<int>(values.integer(name, 0, wide ? v.wide_low : v.low, wide ? v.wide_high : v.high));
          },
          [&](const LongNumber& v) { v.at(scene) = static_cast<long>(values.integer(name, 0, v.low, v.high)); },
          [&](const TruthValue& v) { v.at(scene) = values.truth(name, false); },
          [&](const TextValue& v) { v.at(scene) = values.text(name); },
          [&](const NameValue& v) { v.put(scene, values.name(name, 0, *v.names)); },
          [&](const ListValue& v) {
            v.put(scene, values.numbers(name, v.sizes, allowed(v.range, v.wide, model), v.words));
          },
          [&](const CurveValue& v) {
            if (const auto points = values.pairs(name, v.words)) v.points(scene) = *points;
            else v.file(scene) = values.file(name);
          },
      },
      key.value);
}

/// Puts in what the models take without being told.
void settle_defaults(Scene& scene) {
  if (!scene.body.is_smooth()) {
    scene.body.sectors = scene.body.meshed_sectors();
    scene.body.rings = scene.body.meshed_rings();
  }
  scene.impact.law = restitution_law(scene);
  if (!scene.impact.restitution) scene.impact.restitution = 1;
}

Value value_of(const Key& key, Scene& scene) {
  return std::visit(Overloaded{
                        [&](const OptionalNumber& v) { return v.at(scene) ? Value(*v.at(scene)) : Value(); },
                        [&](const TextValue& v) { return Value(v.at(scene)); },
                        [&](const NameValue& v) { return Value((*v.names)[v.get(scene)]); },
                        [&](const ListValue& v) {
                          const std::vector<double> numbers = v.get(scene);
                          return numbers.empty() ? Value() : Value(numbers);
                        },
                        [&](const CurveValue& v) {
                          Value list;
                          for (const auto& [x, y] : v.points(scene)) list.push_back(Value::List{x, y});
                          return list;
                        },
                        [&](const auto& v) { return Value(v.at(scene)); },
                    },
                    key.value);
}

Echo echo_of(const Key& key, const Scene& scene, Model model) {
  if (key.echo) return key.echo(scene, model);
  const auto& pairs = alternatives();
  const bool is_replaced = std::any_of(pairs.begin(), pairs.end(), [&](const Alternative& pair) {
    return std::string_view(pair.instead_of) == key.name && key_named(pair.key).is_given(scene);
  });
  return is_replaced ? Echo::null : Echo::value;
}

}  // namespace

const std::vector<std::string>& start_names() {
  static const std::vector<std::string> names{"touch", "rest"};
  return names;
}

const std::vector<std::string>& area_names() {
  static const std::vector<std::string> names{"surface", "projected"};
  return names;
}

const std::vector<std::string>& impact_friction_names() {
  static const std::vector<std::string> names{"coulomb", "moreau"};
  return names;
}

const std::vector<std::string>& friction_law_names() {
  static const std::vector<std::string> names{"coulomb", "regularised", "local"};
  return names;
}

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names{"auto", "tvd-rk3", "rk4", "rkf45", "rkck", "rk8pd"};
  return names;
}

const std::vector<std::string>& sweep_names() {
  static const std::vector<std::string> names{"angle_deg", "sliding_friction"};
  return names;
}

std::string Key::allowed() const {
  return std::visit(
      Overloaded{
          [](const WholeNumber& v) {
            const bool is_wide = v.wide_low != v.low || v.wide_high != v.high;
            return fmt::format("a whole number from {} to {}", v.low, v.high) +
                   (is_wide ? fmt::format("; discrete model: from {} to {}", v.wide_low, v.wide_high) : "");
          },
          [](const LongNumber& v) { return fmt::format("a whole number from {} to {}", v.low, v.high); },
          [](const TruthValue&) { return std::string("true or false"); },
          [](const TextValue&) { return std::string("a text"); },
          [](const NameValue& v) { return fmt::format("one of {}", fmt::join(*v.names, ", ")); },
          [](const ListValue& v) { return std::string(v.words); },
          [](const CurveValue& v) { return std::string(v.words); },
          [](const auto& v) {
            return std::string(v.range.words) + (v.wide ? fmt::format("; discrete model: {}", v.wide->words) : "");
          },
      },
      value);
}

Value Key::get(const Scene& scene) const {
  Scene shown = scene;  // the places are those of a scene that may be changed
  settle_defaults(shown);
  const Echo shows = echo_of(*this, scene, Model::continuous);
  return shows == Echo::value ? value_of(*this, shown) : Value();
}

std::string Key::value_type() const {
  const auto* const names = std::get_if<NameValue>(&value);
  return names && *type == '\0' ? fmt::format("{}", fmt::join(*names->names, "|")) : type;
}

std::string Key::argument() const {
  std::string name_ = flag;
  if (name_.empty() || name_.starts_with("--no-")) return std::string(name).substr(std::string(name).rfind('.') + 1);
  name_.erase(0, 2);
  std::replace(name_.begin(), name_.end(), '-', '_');
  return name_;
}

bool Key::is_of_times() const {
  const std::string_view key = name;
  return key == "run.until" || key == "run.at" || key == "run.rate";
}

bool Key::is_whole() const {
  return std::holds_alternative<WholeNumber>(value) || std::holds_alternative<LongNumber>(value);
}

bool Key::is_number() const {
  return is_whole() || std::holds_alternative<NumberValue>(value) || std::holds_alternative<OptionalNumber>(value);
}

bool Key::is_given(const Scene& scene) const {
  Scene shown = scene;  // the places are those of a scene that may be changed
  return std::visit(Overloaded{
                        [&](const OptionalNumber& v) { return v.at(shown).has_value(); },
                        [&](const ListValue& v) { return !v.get(shown).empty(); },
                        [&](const CurveValue& v) { return !v.points(shown).empty(); },
                        [](const auto&) { return true; },
                    },
                    value);
}

void Key::put_number(Scene& scene, double number) const {
  std::visit(Overloaded{
                 [&](const NumberValue& v) { v.at(scene) = number; },
                 [&](const OptionalNumber& v) { v.at(scene) = number; },
                 [&](const WholeNumber& v) { v.at(scene) = static_cast<int>(number); },
                 [&](const LongNumber& v) { v.at(scene) = static_cast<long>(number); },
                 [&](const auto&) { throw std::logic_error(std::string(name) + " is no number"); },
             },
             value);
}

const Key& key_named(std::string_view name) {
  const auto found =
      std::find_if(all_keys().begin(), all_keys().end(), [&](const Key& key) { return key.name == name; });
  if (found == all_keys().end()) throw std::out_of_range("no key " + std::string(name));
  return *found;
}

const std::vector<Alternative>& alternatives() {
  static const std::vector<Alternative> pairs = [] {
    std::vector<Alternative> list;
    for (const Key& key : all_keys()) {
      for (const char* other : key.instead_of) list.push_back({key.name, other});
    }
    return list;
  }();
  return pairs;
}

bool are_alternatives(std::string_view one, std::string_view other) {
  const auto& pairs = alternatives();
  return std::any_of(pairs.begin(), pairs.end(), [&](const Alternative& pair) {
    return (pair.key == one && pair.instead_of == other) || (pair.key == other && pair.instead_of == one);
  });
}

const std::vector<std::string>& scene_keys() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Key& key : all_keys()) list.emplace_back(key.name);
    for (const std::string& swept : sweep_names()) {
      for (const char* part : {"", ".from", ".to", ".step", ".count", ".scale"})
        list.push_back("sweep." + swept + part);
    }
    return list;
  }();
  return names;
}

const std::map<std::string, std::string>& key_flags() {
  static const std::map<std::string, std::string> flags = [] {
    std::map<std::string, std::string> by_key;
    for (const Key& key : all_keys()) {
      if (*key.flag != '\0') by_key.emplace(key.name, key.flag);
    }
    return by_key;
  }();
  return flags;
}

std::string flag_words(const std::vector<SceneOverride>& overrides) {
  std::string words;
  for (const SceneOverride& given : overrides) {
    const Key& key = key_named(given.key);
    const std::string flag = key.flag;
    if (flag.empty() || (key.is_truth() && (given.text == "false") != flag.starts_with("--no-"))) continue;
    words += " " + flag + (key.is_truth() ? "" : " " + shell_word(given.text));
  }
  return words;
}

void put_values(const SceneValues& values, Scene& scene, Model model) {
  for (const Key& key : all_keys()) {
    if (values.has(key.name)) put_given(values, key, scene, model);
  }
}

void add_keys(const Scene& scene, Model model, Value& fields) {
  Scene shown = scene;  // the places are those of a scene that may be changed
  // What the discrete model takes without being told: no friction is a ratio of 0.
  if (model == Model::discrete && !shown.impact.impulse_ratio) shown.impact.impulse_ratio = 0;
  settle_defaults(shown);
  for (const Key& key : all_keys()) {
    if (!key.is_for(model)) continue;
    const Echo echo = echo_of(key, scene, model);
    if (echo == Echo::absent) continue;
    Value* place = &fields;
    std::string name = key.name;
    for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.')) {
      place = &(*place)[name.substr(0, dot)];
      name.erase(0, dot + 1);
    }
    (*place)[name] = echo == Echo::null ? Value() : value_of(key, shown);
  }
}

}  // namespace clatter::validation
