// SPDX-License-Identifier: GPL-3.0-or-later
// An argument of a command as a row of data: parser, help, completion and manual page are made from such rows, and
// Python and the page give the same arguments by name.
#pragma once

#include <fmt/ranges.h>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "validation/output/bad_input.hpp"
#include "validation/scene/option_values.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

// Arguments by the names of the command line's flags, with "_" for "-", for those who have no command line.

using NamedTexts = std::map<std::string, std::string>;

/// What stands in `table` under `name`.  @throws BadInput for an unknown name, with the nearest.
template <class Value>
[[nodiscard]] const Value& named(const std::map<std::string, Value>& table, const std::string& name) {
  const auto found = table.find(name);
  if (found != table.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : table) names.push_back(entry.first);
  throw BadInput(name + ": unknown argument" + suggestion(name, names));
}

/// Flags of `clatter simulate` and the keys of the scene file whose place they take; also planar, contact_gravity,
/// errors, amplification and evaluation_limit.  @throws BadInput for an unknown name, with the nearest.
[[nodiscard]] std::vector<SceneOverride> scene_overrides(const NamedTexts& given);

struct Argument {
  /// Checks the text that was given under a name and puts its value where the row says.  @throws BadInput
  using Reader = std::function<void(const std::string& name, const std::string& text)>;
  /// A truth is a flag without a value; a list takes many values.
  using Target = std::variant<bool*, std::string*, std::vector<std::string>*, Reader>;

  std::string name{};  ///< "--angle", or "SCENE" for an argument known by its place
  Target target{};
  std::string type{};  ///< of the value, in help: "DEG", "a|b|c" (shells offer these), "FILE" (shells offer files)
  std::string help{};
  std::string group{};  ///< heading in help; empty: "Options"
  bool required = false;
  bool repeats = false;  ///< a list that takes one value each time the option is given

  [[nodiscard]] bool is_option() const { return name.starts_with("--"); }
  [[nodiscard]] bool is_flag() const { return std::holds_alternative<bool*>(target); }
  [[nodiscard]] bool is_list() const { return std::holds_alternative<std::vector<std::string>*>(target) && !repeats; }
  /// What the value is chosen from; empty where it is not.
  [[nodiscard]] std::vector<std::string> choices() const;
};
using Arguments = std::vector<Argument>;

// Rows whose value is put into `value`, a plain one or a std::optional, which stays empty where nothing is given.

/// By `read`, (name, text) to value.
[[nodiscard]] Argument read_argument(std::string name, auto& value, auto read, std::string type, std::string help,
                                     std::string group = "") {
  return {.name = std::move(name),
          .target = Argument::Reader(
              [&value, read](const std::string& as, const std::string& text) { value = read(as, text); }),
          .type = std::move(type),
          .help = std::move(help),
          .group = std::move(group)};
}

/// A number in a range.
[[nodiscard]] Argument number_argument(std::string name, auto& value, const Range& range, std::string type,
                                       std::string help, std::string group = "") {
  const auto read = [range](const std::string& as, const std::string& text) {
    return read_number_option(as, text, range);
  };
  return read_argument(std::move(name), value, read, std::move(type), std::move(help), std::move(group));
}

/// A whole number from `low` to `high`.
[[nodiscard]] Argument whole_argument(std::string name, auto& value, int low, int high, std::string type,
                                      std::string help, std::string group = "") {
  const auto read = [low, high](const std::string& as, const std::string& text) {
    return read_integer_option(as, text, low, high);
  };
  return read_argument(std::move(name), value, read, std::move(type), std::move(help), std::move(group));
}

/// One of several names; the value is an enumeration, or a number, in their order.
template <class Value>
[[nodiscard]] Argument choice_argument(std::string name, Value& value, std::vector<std::string> names, std::string help,
                                       std::string group = "") {
  std::string type = fmt::format("{}", fmt::join(names, "|"));
  const auto place = [names = std::move(names)](const std::string& as, const std::string& text) {
    const std::size_t index = read_name_option(as, text, names);
    if constexpr (requires { typename Value::value_type; }) return static_cast<typename Value::value_type>(index);
    else return static_cast<Value>(index);
  };
  return read_argument(std::move(name), value, place, std::move(type), std::move(help), std::move(group));
}

/// Gives the rows what stands under their names, "--gravity-number" as gravity_number.
/// @throws BadInput for a name that no row has, and as the rows
void take(const Arguments& rows, const NamedTexts& given);

}  // namespace clatter::validation
