// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/argument.hpp"

#include <algorithm>
#include <sstream>

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

std::vector<std::string> Argument::choices() const {
  std::vector<std::string> list;
  if (type.find('|') == std::string::npos || type.find('=') != std::string::npos) return list;
  std::istringstream stream(type);
  for (std::string word; std::getline(stream, word, '|');) list.push_back(word);
  return list;
}

void take(const Arguments& rows, const NamedTexts& given) {
  std::map<std::string, const Argument*> by_name;
  for (const Argument& row : rows) {
    std::string name = row.is_option() ? row.name.substr(2) : row.name;
    std::replace(name.begin(), name.end(), '-', '_');
    by_name.emplace(std::move(name), &row);
  }
  for (const auto& [name, text] : given) {
    const Argument& row = *named(by_name, name);
    if (row.is_flag()) *std::get<bool*>(row.target) = read_name_option(row.name, text, {"false", "true"}) == 1;
    else if (auto* const* plain = std::get_if<std::string*>(&row.target)) **plain = text;
    else std::get<Argument::Reader>(row.target)(row.name, text);
  }
}

}  // namespace clatter::validation
