// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/argument.hpp"

#include <algorithm>
#include <map>
#include <sstream>

namespace clatter::validation {

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
