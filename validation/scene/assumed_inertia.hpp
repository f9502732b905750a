// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene leaves to be assumed of its body's inertia.
#pragma once

#include <algorithm>
#include <string>

#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// That a centre of mass which the scene moves leaves the moments of inertia those of the uniform body about its own
/// centre, and which key has others; empty: it moves none, or gives them.
inline std::string uniform_inertia_words(const Scene& scene) {
  const BodyScene& body = scene.body;
  const bool is_moved = std::ranges::any_of(body.centre, [](double place) { return place != 0; });
  if (!body.inertia.empty() || !is_moved) return "";
  return "the uniform body's, which a moved centre of mass leaves as they are; --inertia (body.inertia) gives measured "
         "ones";
}

}  // namespace clatter::validation
