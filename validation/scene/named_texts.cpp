#include "validation/scene/named_texts.hpp"

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

const std::map<std::string, std::string> keys{{"angle", "drop.angle_deg"},
                                              {"tilt", "drop.tilt_deg"},
                                              {"speed", "drop.speed"},
                                              {"height", "drop.height"},
                                              {"tangential_velocity", "drop.tangential_velocity"},
                                              {"spin", "drop.spin"},
                                              {"gravity", "world.gravity"},
                                              {"restitution", "impact.restitution"},
                                              {"restitution_law", "impact.law"},
                                              {"impulse_ratio", "impact.impulse_ratio"},
                                              {"friction", "impact.friction"},
                                              {"body", "body.shape"},
                                              {"mass", "body.mass"},
                                              {"length", "body.length"},
                                              {"radius", "body.radius"},
                                              {"size", "body.size"},
                                              {"stiffness", "ground.stiffness"},
                                              {"damping", "ground.damping"},
                                              {"static_friction", "ground.static_friction"},
                                              {"sliding_friction", "ground.sliding_friction"},
                                              {"area", "ground.area"},
                                              {"impacts", "run.impacts"},
                                              {"digits", "run.digits"},
                                              {"require_digits", "run.require_digits"},
                                              {"method", "run.method"},
                                              {"tolerance", "run.tolerance"},
                                              {"step", "run.step"},
                                              {"planar", "run.planar"},
                                              {"contact_gravity", "run.contact_gravity"},
                                              {"errors", "run.errors"},
                                              {"amplification", "run.amplification"},
                                              {"evaluation_limit", "run.evaluation_limit"}};

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
  for (const auto& [name, text] : given) overrides.push_back({named(keys, name), name, text});
  return overrides;
}

}  // namespace clatter::validation
