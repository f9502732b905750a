// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/bad_input.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>

#include "validation/output/symbols.hpp"

namespace clatter::validation {
namespace {

constexpr std::size_t letter = 8;  ///< what one costs in misspelling()

/// Letters left out, put in or changed, and neighbours exchanged, one each; little for those not typed yet at the end.
std::size_t misspelling(const std::string& from, const std::string& to) {
  std::vector<std::size_t> row(to.size() + 1), above, next;
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    next.assign(1, i);
    for (std::size_t j = 1; j <= to.size(); ++j) {
      next.push_back(std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (from[i - 1] != to[j - 1])}));
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        next[j] = std::min(next[j], above[j - 2] + 1);
    }
    above = std::exchange(row, std::move(next));
  }
  std::size_t least = letter * row.back();
  for (std::size_t j = 0; j <= to.size(); ++j) least = std::min(least, letter * row[j] + to.size() - j);
  return least;
}

/// Whether one may have meant `known`: it has what was typed as a part, or a third of its letters differ.
bool is_near(const std::string& name, const std::string& known) {
  return known.find(name) != std::string::npos ||
         3 * misspelling(name, known) <= letter * (std::max(name.size(), known.size()) + 1);
}

}  // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  const auto nearest =
      std::min_element(candidates.begin(), candidates.end(), [&](const std::string& a, const std::string& b) {
        const auto rank = [&](const std::string& known) {  // what was typed may be a part of it
          return std::pair(known.find(name) == std::string::npos, misspelling(name, known));
        };
        return rank(a) < rank(b);
      });
  return nearest == candidates.end() ? std::string() : *nearest;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& candidates, bool are_listed) {
  constexpr std::size_t few = 12;
  const std::string nearest = nearest_name(name, candidates);
  const bool has_list = are_listed || (!candidates.empty() && candidates.size() <= few);
  if (!has_list || is_near(name, nearest)) return fmt::format("; did you mean {}?", nearest);
  return are_listed ? ""
                    : fmt::format("; there {} {}", candidates.size() == 1 ? "is" : "are", fmt::join(candidates, ", "));
}

void say(const std::string& words) {
  if (Caught<std::string>::open) return Caught<std::string>::open->all.push_back(words);
  std::string line = words;
  std::replace(line.begin(), line.end(), '\n', ' ');
  line = "clatter: " + printable(line) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace clatter::validation
