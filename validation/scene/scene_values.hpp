// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a scene file, with the flags that override them, each knowing where it stands.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "validation/scene/option_values.hpp"

namespace clatter::validation {

/// Keys are dotted: "drop.angle_deg", "body.mesh.sectors".  Each getter checks and says, in one line, where the value
/// stands, what was given and what is allowed.
class SceneValues {
 public:
  /// Reads a TOML file.  @throws BadInput "file:line:column: ..." if it cannot be read, is no TOML, repeats a
  /// key, or has a key that is not among `known` (the nearest one is named).
  SceneValues(const std::string& path, const std::vector<std::string>& known);
  /// The same from `text`; `path` is what messages call it.
  SceneValues(const std::string& path, std::string_view text, const std::vector<std::string>& known);

  /// A flag takes the place of a key.
  void set(const std::string& key, const std::string& flag, const std::string& text);
  void drop(const std::string& key) { entries_.erase(key); }
  /// Puts a number in the place of one of these texts.
  void name_numbers(const std::string& key, const std::map<std::string, double, std::less<>>& names);

  /// What messages call a key that stands in no file: its flag.  @param flags  by key; outlives the values
  void call_by(const std::map<std::string, std::string>& flags) { flags_ = &flags; }

  [[nodiscard]] bool has(const std::string& key) const { return entries_.contains(key); }
  /// Whether any key below the table `name` is given.
  [[nodiscard]] bool has_table(const std::string& name) const;
  /// @throws BadInput if it is not given.
  void require(const std::string& key, const std::string& what) const;
  /// @throws BadInput if both are given.
  void exclude(const std::string& first, const std::string& second) const;

  [[nodiscard]] double number(const std::string& key, double fallback, const Range& range) const;
  [[nodiscard]] long long integer(const std::string& key, long long fallback, long long low, long long high) const;
  [[nodiscard]] bool truth(const std::string& key, bool fallback) const;
  [[nodiscard]] std::string text(const std::string& key) const;
  [[nodiscard]] std::size_t name(const std::string& key, std::size_t fallback,
                                 const std::vector<std::string>& names) const;
  /// As many numbers as `words` says ("three lengths in m, ..."); a flag's text holds them with "x" or "," between.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, const std::vector<std::size_t>& sizes,
                                            const Range& range, const std::string& words) const;

  /// A list of pairs, "[[0, 0], [1, 2]]", that a file or a flag has; none: a text, as of a file's name.
  [[nodiscard]] std::optional<std::vector<std::array<double, 2>>> pairs(const std::string& key,
                                                                        const std::string& words) const;
  /// A text that names a file: of a scene file, from its folder.
  [[nodiscard]] std::string file(const std::string& key) const;

  /// A list of the file with at least one number.
  [[nodiscard]] std::vector<double> number_list(const std::string& key, const Range& range) const;

  /// @throws BadInput "where: key = given: must be ALLOWED".
  [[noreturn]] void refuse(const std::string& key, const std::string& allowed) const;
  /// "file:line:column: key" or "--flag", of a key that is given.
  [[nodiscard]] const std::string& where(const std::string& key) const { return at(key).where; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  using Pairs = std::vector<std::array<double, 2>>;
  /// A text is a flag's or a string of the file; a list holds the file's array, of numbers or of pairs of them.
  struct Entry {
    std::variant<bool, double, long long, std::string, std::vector<double>, Pairs> value;
    std::string shown;  ///< as given
    std::string where;  ///< "file:line:column: key" or "--flag"
    bool is_flag = false;
  };
  friend class SceneParser;

  [[nodiscard]] const Entry& at(const std::string& key) const { return entries_.at(key); }
  /// "file: key", or without a file the flag.
  [[nodiscard]] std::string place_of(const std::string& key) const;

  std::string path_;
  const std::map<std::string, std::string>* flags_ = nullptr;
  std::map<std::string, Entry> entries_;
};

}  // namespace clatter::validation
