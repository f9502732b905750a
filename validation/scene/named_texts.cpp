// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/named_texts.hpp"

#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

/// Keys by the names of their arguments.
const std::map<std::string, std::string>& keys() {
  static const std::map<std::string, std::string> names = [] {
    std::map<std::string, std::string> map;
    for (const Key& key : all_keys()) {
      if (!key.is_file()) map[key.argument()] = key.name;
    }
    return map;
  }();
  return names;
}

}  // namespace

std::vector<SceneOverride> scene_overrides(const NamedTexts& given) {
  std::vector<SceneOverride> overrides;
  for (const auto& [name, text] : given) overrides.push_back({named(keys(), name), name, text});
  return overrides;
}

}  // namespace clatter::validation
