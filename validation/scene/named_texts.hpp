// Arguments by the names of the command line's flags, with "_" for "-", for those who have no command line.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/scene/scene.hpp"
#include "validation/scene/simulation_scene.hpp"

namespace clatter::validation {

using NamedTexts = std::map<std::string, std::string>;

/// Flags of `clatter sequence`.  @throws BadInput for an unknown name, with the nearest.
[[nodiscard]] SceneTexts scene_texts(const NamedTexts& given);

/// Flags of `clatter simulate` and the keys of the scene file whose place they take; also planar, contact_gravity,
/// errors, amplification and evaluation_limit.  @throws BadInput for an unknown name, with the nearest.
[[nodiscard]] std::vector<SceneOverride> scene_overrides(const NamedTexts& given);

}  // namespace clatter::validation
