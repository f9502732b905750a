// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/bad_input.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "validation/output/symbols.hpp"

namespace clatter::validation {
namespace {

std::size_t edit_distance(const std::string& from, const std::string& to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t change = diagonal + (from[i - 1] != to[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  const auto nearest =
      std::min_element(candidates.begin(), candidates.end(), [&](const std::string& a, const std::string& b) {
        const auto rank = [&](const std::string& known) {  // what was typed may be a part of it
          return std::pair(known.find(name) == std::string::npos, edit_distance(name, known));
        };
        return rank(a) < rank(b);
      });
  return nearest == candidates.end() ? std::string() : *nearest;
}

void say(const std::string& words) {
  if (Caught<std::string>::open) return Caught<std::string>::open->all.push_back(words);
  std::string line = words;
  std::replace(line.begin(), line.end(), '\n', ' ');
  line = "clatter: " + printable(line) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace clatter::validation
