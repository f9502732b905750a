// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that go between the page of `clatter demo`, its address and files.
#pragma once

#include "validation/output/value.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// @throws BadInput for what the page does not draw: a mesh, a round body, a sweep, a topple, a release of a body that
/// turns, a start at rest, an inclined ground
void require_shown(const Scene& scene);

/// A scene, with the law that the discrete model takes, as the arguments that give it: {"body": "box", "size": [L, W,
/// T], "angle": 10, …}; but for the body and gravity without those that flags alone would give.  @throws as
/// require_shown
[[nodiscard]] Value::Fields scene_arguments(const Scene& scene);

}  // namespace clatter::validation
