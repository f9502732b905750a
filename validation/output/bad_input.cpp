// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/bad_input.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <compare>
#include <cstdio>
#include <numeric>
#include <tuple>
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

/// A name as it is typed: without the dashes of a flag, the key of a table apart from the table.
struct Spelled {
  explicit Spelled(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot != std::string::npos) table = name.substr(0, dot);
    key = name.substr(dot == std::string::npos ? std::min(name.find_first_not_of('-'), name.size()) : dot + 1);
  }
  std::string table, key;
};

/// How far what was typed is from a name.
struct Distance {
  Distance(const std::string& name, const std::string& known)
      : Distance(Spelled(name), Spelled(known), known.find(name) != std::string::npos) {}
  Distance(const Spelled& from, const Spelled& to, bool is_part)
      : is_other(!is_part), keys(misspelling(from.key, to.key)), tables(from.table != to.table),
        most(letter * std::max<std::size_t>(1, std::min(from.key.size(), to.key.size()) / 3)) {
    if (!from.table.empty() && tables > 0) tables = misspelling(from.table, to.table);
  }
  /// One may have meant it: what was typed is a part of it, or a third of the shorter's letters differ.
  [[nodiscard]] bool is_near() const { return !is_other || keys <= most; }
  bool operator<(const Distance& other) const { return rank() < other.rank(); }

 private:
  [[nodiscard]] std::tuple<bool, std::size_t, std::size_t> rank() const {
    return {is_other, keys + std::min(tables, letter), tables};
  }

  bool is_other;
  std::size_t keys, tables, most;  ///< an other table is as one letter at most
};

}  // namespace

std::optional<std::string> near_name(const std::string& name, const std::vector<std::string>& candidates) {
  const auto nearest = std::min_element(
      candidates.begin(), candidates.end(),
      [&](const std::string& a, const std::string& b) { return Distance(name, a) < Distance(name, b); });
  if (nearest == candidates.end() || !Distance(name, *nearest).is_near()) return std::nullopt;
  return *nearest;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& candidates, bool are_listed) {
  constexpr std::size_t few = 12;
  if (const auto near = near_name(name, candidates)) return fmt::format("; did you mean {}?", *near);
  if (are_listed || candidates.empty() || candidates.size() > few) return "";
  return fmt::format("; there {} {}", candidates.size() == 1 ? "is" : "are", fmt::join(candidates, ", "));
}

void say(const std::string& words) {
  if (Caught<std::string>::open) return Caught<std::string>::open->all.push_back(words);
  std::string line = words;
  std::replace(line.begin(), line.end(), '\n', ' ');
  line = "clatter: " + printable(line) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace clatter::validation
