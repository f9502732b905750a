// SPDX-License-Identifier: GPL-3.0-or-later
// The language of scenes: one row a key.  From the rows come the reader of files, the flags of the commands, the JSON
// echo, what a sweep may set, and the arguments of Python and of the page.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "validation/output/value.hpp"
#include "validation/scene/scene.hpp"
#include "validation/scene/scene_values.hpp"

namespace clatter::validation {

/// The value of a key: where a scene has it, how it is read, and what is allowed.
struct KeyValue {
  enum class Kind { number, whole, truth, text, name, list, curve } kind = Kind::number;
  std::string allowed{};                     ///< in words
  std::function<Value(const Scene&)> get{};  ///< nothing where a scene has none
  /// Puts what is given under the name in its place.  @throws BadInput where it is out of its range
  std::function<void(const SceneValues& values, const std::string& name, Scene& scene, Model model)> read{};
  void (*put)(Scene& scene, double number) = nullptr;  ///< of numbers: whether it is in range is for the reader to say
  Range range = any_number;                            ///< of a number, or of each of a list
  std::vector<std::string> names{};                    ///< to choose from, in the order of an enumeration
  std::string example{};                               ///< as a scene file has it; empty: a number
};

/// How a key stands in the JSON echo of a scene.
enum class Echo { value, null, absent };

/// Which model a key is for.
enum class Use { both, discrete, continuous };

struct Key {
  const char* name;  ///< "drop.angle_deg"
  Use use;
  const char* flag;  ///< "--angle"; empty: it has none
  const char* type;  ///< of the flag's value, in help: "DEG"; empty: a flag without a value, or one of names
  const char* unit;  ///< empty: none
  const char* help;
  KeyValue value;
  /// None: its value, and null where that is empty or another key is given instead.
  Echo (*echo)(const Scene& scene, Model model) = nullptr;
  std::vector<const char*> instead_of{};  ///< keys whose place it takes: a scene has it or some of them
  bool is_required = false;               ///< no scene of the continuous model is without it

  /// What the flag's value is in help: `type`, or the names to choose from, "rod|box|mesh".
  [[nodiscard]] std::string value_type() const;
  /// Name of the argument in Python and on the page: the flag's, or without one the key's last word.
  [[nodiscard]] std::string argument() const;
  [[nodiscard]] bool is_for(Model model) const {
    return use == Use::both || (use == Use::continuous) == (model == Model::continuous);
  }
  /// Whether it says at which times the motion is told, or ends: of the commands alone that tell it.
  [[nodiscard]] bool is_of_times() const;
  [[nodiscard]] bool is_truth() const { return value.kind == KeyValue::Kind::truth; }
  [[nodiscard]] bool is_number() const { return value.put != nullptr; }
  [[nodiscard]] bool is_whole() const { return value.kind == KeyValue::Kind::whole; }
  [[nodiscard]] bool is_of_body() const { return std::string_view(name).starts_with("body."); }
  /// Whether its value names a file, which only the command line and scene files may.
  [[nodiscard]] bool is_file() const { return std::string_view(type) == "FILE"; }
  /// What is allowed, in words: "greater than 0", "one of rod, box, mesh".
  [[nodiscard]] const std::string& allowed() const { return value.allowed; }
  /// Its value in a scene, null or absent as in the echo.
  [[nodiscard]] Value get(const Scene& scene) const;
  /// Whether a scene has a value of it.
  [[nodiscard]] bool is_given(const Scene& scene) const { return !value.get(scene).is_nothing(); }
  /// @pre is_number()
  void put_number(Scene& scene, double number) const { value.put(scene, number); }
};

/// In the order of the echo.
[[nodiscard]] const std::vector<Key>& all_keys();
/// @throws std::out_of_range
[[nodiscard]] const Key& key_named(std::string_view name);
/// Pairs of a key and one whose place it takes: no scene has both.
struct Alternative {
  const char* key;
  const char* instead_of;
};
[[nodiscard]] const std::vector<Alternative>& alternatives();
/// Whether one of two keys takes the place of the other.
[[nodiscard]] bool are_alternatives(std::string_view one, std::string_view other);
/// Keys of which a scene has one that has a ground.
inline constexpr std::array ground_keys{"ground.stiffness", "ground.modulus", "ground.floor", "ground.curve"};
/// Names of the keys, and of those that a file's sweep has.
[[nodiscard]] const std::vector<std::string>& scene_keys();

/// The flag of each key that has one.
[[nodiscard]] const std::map<std::string, std::string>& key_flags();

/// " --angle 10 --planar": what to type for these overrides, each as the flag of its key; a key without one is left
/// out.
[[nodiscard]] std::string flag_words(const std::vector<SceneOverride>& overrides);

/// Puts each key that is given in its place.  @throws BadInput where one is out of its range.
void put_values(const SceneValues& values, Scene& scene, Model model);
/// Adds every key of the model under its table's name.
void add_keys(const Scene& scene, Model model, Value& fields);

/// Names of choices, in the order of their enumerators.
[[nodiscard]] const std::vector<std::string>& shape_names();
[[nodiscard]] const std::vector<std::string>& law_names();
[[nodiscard]] const std::vector<std::string>& area_names();
[[nodiscard]] const std::vector<std::string>& method_names();
[[nodiscard]] const std::vector<std::string>& sweep_names();

// A scene as others read it again: the keys that it has to say, and the text of a file.

/// What flags alone give a body of this shape.
[[nodiscard]] Scene bare_scene(BodyScene::Shape shape);

/// Keys whose values flags alone would not give, in the order of the echo, but for files; those of the body, gravity
/// and restitution in any case.
[[nodiscard]] std::vector<const Key*> said_keys(const Scene& scene);

/// `head`, then the keys under their tables, each as `line` writes it; `name` is the key's within its table.
[[nodiscard]] std::string scene_text(const std::string& head, const std::vector<const Key*>& keys,
                                     const std::function<std::string(const Key& key, const std::string& name)>& line);

}  // namespace clatter::validation
