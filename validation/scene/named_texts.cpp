#include "validation/scene/named_texts.hpp"

#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

using Member = std::optional<std::string> SceneTexts::*;

const std::map<std::string, Member> members{{"angle", &SceneTexts::angle},
                                            {"speed", &SceneTexts::speed},
                                            {"height", &SceneTexts::height},
                                            {"tangential_velocity", &SceneTexts::tangential_velocity},
                                            {"spin", &SceneTexts::spin},
                                            {"gravity", &SceneTexts::gravity},
                                            {"restitution", &SceneTexts::restitution},
                                            {"restitution_law", &SceneTexts::restitution_law},
                                            {"impulse_ratio", &SceneTexts::impulse_ratio},
                                            {"friction", &SceneTexts::friction},
                                            {"body", &SceneTexts::body},
                                            {"mass", &SceneTexts::mass},
                                            {"length", &SceneTexts::length},
                                            {"radius", &SceneTexts::radius},
                                            {"size", &SceneTexts::size},
                                            {"impacts", &SceneTexts::impacts},
                                            {"digits", &SceneTexts::digits}};

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

SceneTexts scene_texts(const NamedTexts& given) {
  SceneTexts texts;
  for (const auto& [name, text] : given) {
    if (name == "require_digits") texts.require_digits = read_name_option(name, text, {"false", "true"}) == 1;
    else texts.*named(members, name) = text;
  }
  return texts;
}

std::vector<SceneOverride> scene_overrides(const NamedTexts& given) {
  std::vector<SceneOverride> overrides;
  for (const auto& [name, text] : given) overrides.push_back({named(keys(), name), name, text});
  return overrides;
}

}  // namespace clatter::validation
