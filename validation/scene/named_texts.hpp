// SPDX-License-Identifier: GPL-3.0-or-later
// Arguments by the names of the command line's flags, with "_" for "-", for those who have no command line.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/output/bad_input.hpp"
#include "validation/scene/option_values.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

using NamedTexts = std::map<std::string, std::string>;

/// What stands in `table` under `name`.  @throws BadInput for an unknown name, with the nearest.
template <class Value>
[[nodiscard]] const Value& named(const std::map<std::string, Value>& table, const std::string& name) {
  const auto found = table.find(name);
  if (found != table.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : table) names.push_back(entry.first);
  throw BadInput(name + ": unknown argument; did you mean " + nearest_name(name, names) + "?");
}

/// Flags of `clatter simulate` and the keys of the scene file whose place they take; also planar, contact_gravity,
/// errors, amplification and evaluation_limit.  @throws BadInput for an unknown name, with the nearest.
[[nodiscard]] std::vector<SceneOverride> scene_overrides(const NamedTexts& given);

}  // namespace clatter::validation
