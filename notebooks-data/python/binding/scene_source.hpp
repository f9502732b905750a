// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as Python hands it over.
#pragma once

#include <optional>
#include <string>

#include "validation/scene/keys.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::python {

/// `text`: the content of a scene file, `name` what messages call it; without a text the file `name`, or none ("").
struct SceneSource {
  std::string name;
  std::optional<std::string> text;

  [[nodiscard]] validation::SceneValues values() const {
    return text ? validation::SceneValues(name, *text, validation::scene_keys()) : validation::scene_values(name);
  }
};

}  // namespace clatter::python
