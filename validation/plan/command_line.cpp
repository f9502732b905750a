// SPDX-License-Identifier: GPL-3.0-or-later
// The command that runs a plan's choice.
#include <fmt/format.h>

#include <algorithm>

#include "validation/output/number.hpp"
#include "validation/output/shell_word.hpp"
#include "validation/plan/plan.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

using Overrides = std::vector<SceneOverride>;

/// What the choice of a continuous level sets.
Overrides chosen_keys(const Plan& plan) {
  Overrides keys{{"run.method", "", method_name(plan.choice.method)},
                 {"run.tolerance", "", shortest(plan.choice.tolerance)}};
  if (plan.choice.level == ModelLevel::planar && !plan.scene.world.planar) keys.push_back({"run.planar", "", "true"});
  for (const WeighedPart& part : plan.parts) {
    if (part.left_out && part.part == Part::friction) {
      for (const char* key : {"ground.static_friction", "ground.sliding_friction"}) keys.push_back({key, "", "0"});
    }
    if (part.left_out && part.part == Part::damping) keys.push_back({"ground.damping", "", "0"});
  }
  return keys;
}

/// The flags that were given, but those of keys that the choice sets or that its model does not have.
Overrides kept(const Plan& plan, const Overrides& chosen) {
  const Model model = is_continuous(plan.choice.level) ? Model::continuous : Model::discrete;
  Overrides rest = plan.given;
  std::erase_if(rest, [&](const SceneOverride& given) {
    return given.key == "run.step" || !key_named(given.key).is_for(model) ||
           std::ranges::any_of(chosen, [&](const SceneOverride& set) { return set.key == given.key; });
  });
  return rest;
}

}  // namespace

std::string command_line(const Plan& plan) {
  const bool continuous = is_continuous(plan.choice.level);
  const std::string source = name_of_source(plan.scene.path);
  const Overrides chosen = continuous ? chosen_keys(plan) : Overrides{};
  return fmt::format("clatter {}{}{}{}", continuous ? "simulate" : "sequence",
                     source.empty() ? "" : " " + shell_word(source), flag_words(kept(plan, chosen)),
                     flag_words(chosen));
}

}  // namespace clatter::validation
