// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/colours.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace clatter::validation {

bool shows_colours() {
  const char* const terminal = std::getenv("TERM");
  return isatty(STDOUT_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

std::string with_colours(const std::string& table) {
  std::size_t begin = table.find("──");  // the rule below heading and units
  for (int lines = 0; lines < 3 && begin != std::string::npos; ++lines) {
    begin = begin == 0 ? std::string::npos : table.rfind('\n', begin - 1);
  }
  if (begin == std::string::npos) return table;
  std::string out = "\033[2m" + table.substr(0, begin) + "\033[0m";
  for (std::size_t i = begin; i < table.size(); ++i) {
    const bool alone =
        table[i] == '?' && table[i - 1] == ' ' && i + 1 < table.size() && (table[i + 1] == ' ' || table[i + 1] == '\n');
    out += alone ? "\033[1m?\033[0m" : std::string(1, table[i]);
  }
  return out;
}

}  // namespace clatter::validation
