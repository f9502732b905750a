// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/scene_values.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/sink.hpp"
#include "validation/output/symbols.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation {
namespace {

std::string position(const std::string& path, const toml::source_region& region) {
  return fmt::format("{}:{}:{}", path, region.begin.line, region.begin.column);
}

/// One line: the parser quotes what it met, the end of a line as well.
std::string words_of(const toml::parse_error& error) { return printable(error.description()); }

std::string as_given(const auto& node) {
  if (const auto real = node.template value_exact<double>()) return shortest(*real);
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  std::string line = text.str();
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

toml::table parse(const std::string& path, std::string_view text) {
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw BadInput("{}: {}", position(path, error.source()), words_of(error));
  }
}

/// Refuses what is plainly of another kind, about which the parser would only say at which byte it gave up.
void refuse_other_files(const std::string& path, std::string_view text) {
  const std::string_view begin = text.substr(0, 4096);
  const auto is_control = [](char c) { return (c >= 0 && c < ' ' && (c < '\t' || c > '\r')) || c == '\x7f'; };
  if (std::any_of(begin.begin(), begin.end(), is_control))
    throw BadInput("{}: is a binary file; a scene is a text (TOML), as clatter init writes it", path);
  if (begin.starts_with("# clatter ") && begin.find("\n# scene: {") != std::string_view::npos) {
    throw BadInput(
        "{}: is what clatter computed, no scene; --summary sums drops up as they are computed: give the sweep's own "
        "SCENE and keys",
        path);
  }
  std::istringstream lines{std::string(begin)};
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(" \t\r\xEF\xBB\xBF");
    if (first == std::string::npos || line[first] == '#') continue;
    const bool is_table =
        line.find_first_of("=[{\"'") == std::string::npos && line.find_first_of(",;\t", first) != std::string::npos;
    if (is_table) throw BadInput("{}: is a table of values (CSV); a scene is TOML, as clatter init writes it", path);
    return;
  }
}

/// The text of a file, or of a pipe, which has no length and may not end.
std::string text_of(const std::string& path) {
  constexpr std::size_t longest = 16 << 20;
  std::ifstream file(path, std::ios::binary);
  std::string text;
  std::array<char, 1 << 16> block;
  while (file.read(block.data(), block.size()), file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() <= longest) continue;
    refuse_other_files(path, text);
    throw BadInput("{}: longer than any scene, 16 MB", path);
  }
  if (!file.is_open() || file.bad()) throw BadInput("{}: cannot be read", path);
  return text;
}

toml::table parse(const std::string& path) {
  if (std::error_code error; !std::filesystem::is_regular_file(path, error) && !std::filesystem::is_fifo(path, error))
    throw BadInput("{}: {}", path, std::filesystem::exists(path, error) ? "not a file" : "cannot be read");
  note_read(path);
  const std::string text = text_of(path);
  refuse_other_files(path, text);
  return parse(path, text);
}

/// [[1, 2], [3, 4]]; none: something else.
std::optional<std::vector<std::array<double, 2>>> pairs_of(const toml::array& list) {
  std::vector<std::array<double, 2>> pairs;
  for (const toml::node& node : list) {
    const toml::array* const pair = node.as_array();
    if (!pair || pair->size() != 2 || !pair->get(0)->is_number() || !pair->get(1)->is_number()) return std::nullopt;
    pairs.push_back({*pair->get(0)->value<double>(), *pair->get(1)->value<double>()});
  }
  if (pairs.empty()) return std::nullopt;
  return pairs;
}

/// What is allowed, with a list as a file has it, "[1, 2, 3]", written as a flag takes it: "1,2,3".
std::string as_flag(std::string words) {
  const std::size_t begin = words.find('['), end = words.find(']', begin);
  if (begin == std::string::npos || end == std::string::npos) return words;
  std::string list = words.substr(begin + 1, end - begin - 1);
  std::erase(list, ' ');
  return words.replace(begin, end + 1 - begin, list);
}

}  // namespace

/// Flattens the tables of a file.
class SceneParser {
 public:
  SceneParser(SceneValues& values, const std::vector<std::string>& known) : values_(values), known_(known) {}

  void add(const toml::table& table, const std::string& prefix) {
    for (const auto& [name, node] : table) {
      const std::string key = prefix.empty() ? std::string(name.str()) : prefix + "." + std::string(name.str());
      const std::string where = position(values_.path_, name.source());
      check_name(std::string(name.str()), where);
      if (key == probes_name) {
        add_probes(node, where);
      } else if (const toml::table* inner = node.as_table()) {
        check_table(key, where);
        add(*inner, key);
      } else {
        check_key(key, where);
        add_value(key, node);
      }
    }
  }

 private:
  /// [[probe]]: the keys of table i become "probe.i.name" and "probe.i.place".
  void add_probes(const toml::node& node, const std::string& where) {
    const toml::array* const list = node.as_array();
    if (!list || !list->is_array_of_tables())
      throw BadInput("{}: {}: must be tables, each [[{}]] with name and place", where, probes_name, probes_name);
    for (std::size_t i = 0; i < list->size(); ++i) {
      const toml::table& table = *list->get(i)->as_table();
      if (table.empty())
        throw BadInput("{}: {}: required, name and place", position(values_.path_, table.source()), probes_name);
      for (const auto& [name, value] : table) {
        const std::string part(name.str());
        if (part != "name" && part != "place" && part != "part")
          throw BadInput(
              "{}: {}.{}: unknown key{}", position(values_.path_, name.source()), probes_name, part,
              suggestion(fmt::format("{}.{}", probes_name, part), {"probe.name", "probe.place", "probe.part"}));
        add_value(fmt::format("{}.{}.{}", probes_name, i, part), value);
      }
    }
  }

  /// A quoted name with a dot in it would look like a key of a table.
  static void check_name(const std::string& name, const std::string& where) {
    if (name.find('.') == std::string::npos) return;
    throw BadInput("{}: \"{}\": unknown key; tables and keys have no dots in their names", where, name);
  }

  void check_key(const std::string& key, const std::string& where) const {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) return;
    throw BadInput("{}: {}: unknown key{}", where, key, suggestion(key, known_));
  }

  void check_table(const std::string& key, const std::string& where) const {
    const bool known =
        std::any_of(known_.begin(), known_.end(), [&](const std::string& name) { return name.starts_with(key + "."); });
    if (known) return;
    if (std::find(known_.begin(), known_.end(), key) != known_.end())
      throw BadInput("{}: {}: must be a value, not a table", where, key);
    std::vector<std::string> tables;
    for (const std::string& name : known_) tables.push_back(name.substr(0, name.rfind('.')));
    throw BadInput("{}: {}: unknown table{}", where, key, suggestion(key, tables));
  }

  void add_value(const std::string& key, const toml::node& node) {
    SceneValues::Entry entry;
    entry.where = position(values_.path_, node.source()) + ": " + key;
    entry.shown = as_given(node);
    if (const auto truth = node.value_exact<bool>()) entry.value = *truth;
    else if (const auto whole = node.value_exact<std::int64_t>()) entry.value = static_cast<long long>(*whole);
    else if (const auto real = node.value_exact<double>()) entry.value = *real;
    else if (const auto words = node.value_exact<std::string>()) entry.value = *words;
    else if (const toml::array* list = node.as_array(); list && pairs_of(*list))
      entry = pairs_entry(*list, entry.where);
    else if (list) entry.value = numbers_of(*list, entry.where, entry.shown);
    else throw BadInput("{} = {}: must be a number, a text or a list", entry.where, entry.shown);
    values_.entries_[key] = std::move(entry);
  }

  static SceneValues::Entry pairs_entry(const toml::array& list, const std::string& where) {
    constexpr std::size_t most_shown = 60;
    const SceneValues::Pairs pairs = *pairs_of(list);
    std::string shown;
    for (const auto& [x, y] : pairs)
      shown += fmt::format("{}[{}, {}]", shown.empty() ? "[" : ", ", shortest(x), shortest(y));
    if (shown.size() > most_shown) shown = shown.substr(0, most_shown) + "...";
    return {pairs, shown + "]", where};
  }

  static std::vector<double> numbers_of(const toml::array& list, const std::string& where, const std::string& shown) {
    std::vector<double> numbers;
    for (const toml::node& node : list) {
      if (!node.is_number()) throw BadInput("{} = {}: must be a list of numbers", where, shown);
      numbers.push_back(*node.value<double>());
    }
    return numbers;
  }

  static constexpr const char* probes_name = "probe";  // as probe_table of probes.hpp, which stands above this

  SceneValues& values_;
  const std::vector<std::string>& known_;
};

SceneValues::SceneValues(const std::string& path, const std::vector<std::string>& known) : path_(path) {
  SceneParser(*this, known).add(parse(path), "");
}

SceneValues::SceneValues(const std::string& path, std::string_view text, const std::vector<std::string>& known)
    : path_(path) {
  SceneParser(*this, known).add(parse(path, text), "");
}

void SceneValues::set(const std::string& key, const std::string& flag, const std::string& text) {
  entries_[key] = {text, fmt::format("'{}'", text), flag, true};
}

void SceneValues::name_numbers(const std::string& key, const std::map<std::string, double, std::less<>>& names) {
  const auto entry = entries_.find(key);
  if (entry == entries_.end()) return;
  const auto* const text = std::get_if<std::string>(&entry->second.value);
  const auto number = text ? names.find(*text) : names.end();
  if (number == names.end()) return;
  entry->second.value = number->second;
  entry->second.is_flag = false;
}

bool SceneValues::has_table(const std::string& name) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const auto& entry) { return entry.first.starts_with(name + "."); });
}

std::string SceneValues::place_of(const std::string& key) const {
  if (!path_.empty()) return path_ + ": " + key;
  const auto flag = flags_ ? flags_->find(key) : std::map<std::string, std::string>::const_iterator{};
  return flags_ && flag != flags_->end() ? flag->second : key;
}

void SceneValues::require(const std::string& key, const std::string& what) const {
  if (!has(key)) throw BadInput("{}: required, {}", place_of(key), what);
}

void SceneValues::exclude(const std::string& first, const std::string& second) const {
  if (!has(first) || !has(second)) return;
  if (at(first).is_flag && at(second).is_flag) {
    const auto typed = [&](const std::string& key) {
      return at(key).where + " " + std::get<std::string>(at(key).value);
    };
    throw BadInput("{} and {}: give one of them, not both", typed(first), typed(second));
  }
  throw BadInput("{} = {}: excludes {}; give one of them, not both", at(second).where, at(second).shown, first);
}

void SceneValues::refuse(const std::string& key, const std::string& allowed) const {
  const auto entry = entries_.find(key);
  if (entry == entries_.end()) throw BadInput("{}: must be {}", place_of(key), allowed);
  const Entry& given = entry->second;
  throw BadInput("{}{}{}: must be {}", given.where, given.is_flag ? " " : " = ", given.shown, allowed);
}

double SceneValues::number(const std::string& key, double fallback, const Range& range) const {
  if (!has(key)) return fallback;
  const Entry& entry = at(key);
  if (entry.is_flag) return read_number_option(entry.where, std::get<std::string>(entry.value), range);
  double value = std::nan("");
  if (const auto* real = std::get_if<double>(&entry.value)) value = *real;
  if (const auto* whole = std::get_if<long long>(&entry.value)) value = static_cast<double>(*whole);
  if (!range.holds(value)) refuse(key, fmt::format("a number, {}", range.allowed()));
  return value;
}

long long SceneValues::integer(const std::string& key, long long fallback, long long low, long long high) const {
  if (!has(key)) return fallback;
  const Entry& entry = at(key);
  long long value = low - 1;
  if (entry.is_flag) {
    if (!read_integer(std::get<std::string>(entry.value), value)) value = low - 1;
  } else if (const auto* whole = std::get_if<long long>(&entry.value)) {
    value = *whole;
  }
  if (value < low || value > high) refuse(key, fmt::format("a whole number from {} to {}", low, high));
  return value;
}

bool SceneValues::truth(const std::string& key, bool fallback) const {
  if (!has(key)) return fallback;
  const Entry& entry = at(key);
  if (const auto* truth = std::get_if<bool>(&entry.value)) return *truth;
  const auto* const words = std::get_if<std::string>(&entry.value);
  if (entry.is_flag && (*words == "true" || *words == "false")) return *words == "true";
  refuse(key, "true or false");
}

std::string SceneValues::text(const std::string& key) const {
  if (!has(key)) return "";
  const auto* words = std::get_if<std::string>(&at(key).value);
  if (!words || words->empty()) refuse(key, "a text in quotes, not empty");
  return *words;
}

std::optional<SceneValues::Pairs> SceneValues::pairs(const std::string& key, const std::string& words) const {
  const Entry& entry = at(key);
  if (const auto* list = std::get_if<Pairs>(&entry.value)) return *list;
  const auto* const text = std::get_if<std::string>(&entry.value);
  if (!text || text->empty()) refuse(key, words);
  if (!entry.is_flag || text->front() != '[') return std::nullopt;
  std::optional<Pairs> list;
  try {
    const toml::table table = toml::parse("list = " + *text);
    if (const toml::array* array = table["list"].as_array()) list = pairs_of(*array);
  } catch (const toml::parse_error&) {
    list.reset();
  }
  if (!list) refuse(key, words);
  return list;
}

std::string SceneValues::file(const std::string& key) const {
  const std::filesystem::path file = text(key);
  return at(key).is_flag || file.is_absolute() ? file.string()
                                               : (std::filesystem::path(path_).parent_path() / file).string();
}

std::size_t SceneValues::name(const std::string& key, std::size_t fallback,
                              const std::vector<std::string>& names) const {
  if (!has(key)) return fallback;
  const std::string allowed = fmt::format("one of {}", fmt::join(names, ", "));
  const auto* given = std::get_if<std::string>(&at(key).value);
  if (!given) refuse(key, allowed);
  const auto found = std::find(names.begin(), names.end(), *given);
  if (found == names.end()) refuse(key, allowed + suggestion(*given, names, true));
  return static_cast<std::size_t>(found - names.begin());
}

std::vector<double> SceneValues::number_list(const std::string& key, const Range& range) const {
  const auto* const list = std::get_if<std::vector<double>>(&at(key).value);
  const auto fits = [&](double value) { return range.holds(value); };
  if (!list || list->empty() || !std::all_of(list->begin(), list->end(), fits))
    refuse(key, fmt::format("a list of numbers, each {}", range.allowed()));
  return *list;
}

std::vector<double> SceneValues::numbers(const std::string& key, const std::vector<std::size_t>& sizes,
                                         const Range& range, const std::string& words) const {
  if (!has(key)) return {};
  const Entry& entry = at(key);
  std::vector<double> numbers;
  if (const auto* list = std::get_if<std::vector<double>>(&entry.value)) numbers = *list;
  if (entry.is_flag) {
    std::string text = std::get<std::string>(entry.value);
    std::replace(text.begin(), text.end(), ',', 'x');
    std::istringstream parts(text + "x");  // so that an empty last part counts
    for (std::string part; std::getline(parts, part, 'x');) {
      double value = 0;
      const std::size_t begin = std::min(part.find_first_not_of(' '), part.size());
      numbers.push_back(read_number(part.substr(begin, part.find_last_not_of(' ') + 1 - begin), value) ? value
                                                                                                       : std::nan(""));
    }
  }
  const bool has_size = std::find(sizes.begin(), sizes.end(), numbers.size()) != sizes.end();
  const bool right = (sizes.empty() ? !numbers.empty() : has_size) &&
                     std::all_of(numbers.begin(), numbers.end(), [&](double value) { return range.holds(value); });
  if (!right) refuse(key, entry.is_flag ? as_flag(words) : words);
  return numbers;
}

}  // namespace clatter::validation
